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

/// Size of the next level.
std::string next_level_text(const Statistics& s) {
  constexpr std::uint64_t kBytesPerFace = 44;  // as docs/architecture.md counts them
  const std::uint64_t faces = 4 * static_cast<std::uint64_t>(s.faces);
  return fmt::format("{} faces, {}", count_text(faces), bytes_text(kBytesPerFace * faces));
}

void draw_levels(Document& document) {
  const std::uint32_t level = shown_level(document.edits);
  const bool has_faces = document.statistics.faces > 0;
  if (half_button("subdivide", has_faces && level < kMaxLevel,
                  ("S: " + next_level_text(document.statistics)).c_str())) {
    request_subdivide(document);
  }
  ImGui::SameLine();
  if (half_button("previous level", level > 0,
                  level > 0 ? "Shift+S" : "already at the coarsest level")) {
    request_previous_level(document);
  }
  label("level");
  ImGui::Text("%u", level);
  tooltip(
      "The model before subdivision is kept, so you can change the level and the rules at any\n"
      "time without loss.");
}

}  // namespace

float draw_subdivide_panel(Document& document, float top, PanelAreas& areas) {
  if (begin_side_panel("Subdivide", top)) {
    draw_levels(document);
    ImGui::Separator();
    if (edit_options(subdivide::kSubdivideRules, document.subdivide))
      apply_subdivide_settings(document);
    if (const auto& last = document.edits.last_subdivision) {
      label("last");
      const std::string text =
          fmt::format("{} in {}", count_text(last->faces, "face"), seconds_text(last->seconds));
      ImGui::TextUnformatted(text.c_str());
    }
  }
  return end_side_panel(areas);
}

}  // namespace mesher::app
