#include <fmt/format.h>
#include <imgui.h>

#include "app/document/shown.h"
#include "app/edit/edits.h"
#include "app/edit/subdivide_edit.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

void draw_level(const Document& document) {
  label("level");
  ImGui::Text("%u", shown_level(document.edits));
  tooltip(
      "The model before subdivision is kept, so you can change the level and the rules at any time "
      "without loss.");
  constexpr std::uint64_t kBytesPerFace = 44;  // as docs/architecture.md counts them
  const std::uint64_t faces = 4 * static_cast<std::uint64_t>(document.statistics.faces);
  label("next level");
  ImGui::TextUnformatted(count_text(faces, "face").c_str());
  label("its memory");
  ImGui::TextUnformatted(bytes_text(kBytesPerFace * faces).c_str());
}

void draw_buttons(Document& document) {
  const std::uint32_t level = shown_level(document.edits);
  const bool can_refine = document.statistics.faces > 0 && level < kMaxLevel;
  if (half_button("subdivide", can_refine, "S")) request_subdivide(document);
  ImGui::SameLine();
  if (half_button("previous level", level > 0,
                  level > 0 ? "Shift+S" : "already at the coarsest level")) {
    request_previous_level(document);
  }
}

void draw_result(const Edits& edits) {
  const auto last = edits.subdivision_outcome();
  if (last == nullptr || shown_level(edits) == 0)
    return faint_text("The shown model is not the result of a subdivision.");
  label("result");
  const std::string text =
      fmt::format("{} in {}", count_text(last->faces, "face"), seconds_text(last->seconds));
  ImGui::TextUnformatted(text.c_str());
}

}  // namespace

void draw_subdivide_tool(Document& document, Block block) {
  switch (block) {
    case Block::settings:
      heading("Target");
      draw_level(document);
      heading("Rules");
      if (edit_options(subdivide::kSubdivideRules, document.subdivide))
        apply_subdivide_settings(document);
      return;
    case Block::apply:
      heading("Apply");
      return draw_buttons(document);
    case Block::result:
      heading("Result");
      return draw_result(document.edits);
  }
}

}  // namespace mesher::app
