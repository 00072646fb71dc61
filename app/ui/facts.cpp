#include <fmt/format.h>
#include <imgui.h>

#include "app/document/shown.h"
#include "app/edit/edits.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/ui/style.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

const std::string kOpened = "opened";

/// Counts of a level. Collapses change neither the genus nor the number of boundary loops.
void draw_level_counts(const Mesh& mesh, const Statistics& of_model) {
  row("vertices", count_text(mesh.vertex_count()));
  row("edges", count_text(std::int64_t(mesh.vertex_count()) + mesh.face_count() -
                          of_model.euler_characteristic));
  row("faces", count_text(mesh.face_count()));
}

void draw_counts(const Document& document) {
  heading("Mesh");
  if (!begin_rows("counts")) return;
  const Statistics& all = document.statistics;
  if (document.progressive.is_on()) {
    draw_level_counts(shown_mesh(document), all);
  } else {
    for (const Count& count : kCounts) {
      if (!count.hides_zero || count.of(all) > 0) row(count.label, count_text(count.of(all)));
    }
  }
  ImGui::EndTable();
}

/// A line of the history. Steps whose difference was dropped for memory cannot be reached.
void draw_step(Document& document, std::size_t steps) {
  const History& history = document.edits.history;
  const std::string& name = steps == 0 ? kOpened : history.steps()[steps - 1].name;
  const bool is_kept = steps >= history.done_steps() - history.undo_depth();
  ImGui::PushID(static_cast<int>(steps));
  const float end = content_end();
  if (ImGui::Selectable("##step", steps == history.done_steps(),
                        is_kept ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled)) {
    request_history_step(document, steps);
  }
  ellipsis_text(name, end, is_kept);
  note_widget("step " + std::to_string(steps));
  tooltip(is_kept ? name.c_str() : "Too old: its memory was given to newer edits.");
  ImGui::PopID();
}

void draw_history(Document& document, std::size_t& shown_step) {
  const History& history = document.edits.history;
  const std::size_t count = history.steps().size() + 1;
  heading("History");
  // A list of its own, so that a long history moves nothing else.
  constexpr std::size_t kMostLines = 8;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  ImGui::BeginChild("steps", {0.0F, static_cast<float>(std::min(count, kMostLines)) * line});
  if (shown_step != history.done_steps()) {
    shown_step = history.done_steps();
    ImGui::SetScrollY(line * (static_cast<float>(shown_step) - 0.5F * kMostLines));
  }
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(count), line);
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
      draw_step(document, static_cast<std::size_t>(i));
  }
  ImGui::EndChild();
}

void draw_size(const Statistics& all) {
  heading("Size");
  if (!all.box.is_empty()) {
    const glm::dvec3 size = glm::dvec3(all.box.max) - glm::dvec3(all.box.min);
    // A line of its own, because it is too long for the second column.
    ImGui::TextWrapped("%s",
                       fmt::format("{:.4g} x {:.4g} x {:.4g}", size.x, size.y, size.z).c_str());
    tooltip("Lengths along X, Y and Z.");
  }
  if (!begin_rows("size")) return;
  row("diagonal", number_text(all.box.diagonal()));
  row("area", number_text(all.area));
  if (all.is_closed() && all.faces > 0) row("volume", number_text(all.volume));
  ImGui::EndTable();
}

void draw_health(const Document& document) {
  heading("Health");
  faint_text(document.statistics.is_closed() ? "closed manifold" : "manifold with boundary");
  const BuildReport& report = document.model.report;
  if (report.is_clean()) faint_text("no repairs were needed");
  for (std::size_t i = 0; i < kRepairs.size(); ++i) {
    const auto repair = static_cast<Repair>(i);
    if (report[repair] == 0) continue;
    const std::string text =
        count_phrase(static_cast<std::int64_t>(report[repair]), describe(repair));
    ImGui::TextWrapped("%s", text.c_str());
  }
  for (const std::string& warning : document.model.contents.warnings())
    ImGui::TextWrapped("%s", warning.c_str());
}

void draw_gpu(const PanelFacts& facts) {
  heading("GPU");
  if (!begin_rows("gpu")) return;
  if (facts.frame_ms > 0.0) row("frame", seconds_text(1e-3 * facts.frame_ms));
  row("uploaded", bytes_text(facts.upload.uploaded_bytes));
  row("whole mesh", bytes_text(facts.upload.total_bytes));
  ImGui::EndTable();
  faint_text(facts.device);
}

}  // namespace

void draw_model_tool(Document& document, Ui& ui) {
  if (document.opening == 0) return faint_text("No model is open yet.");
  note_text(document.model.name);
  ImGui::TextWrapped("%s", document.model.name.c_str());
  draw_scene(document, ui);
  draw_history(document, ui.shown_step);
  draw_size(document.statistics);
  draw_health(document);
  draw_counts(document);
  draw_gpu(ui.facts);
}

void draw_facts(Document& document, Ui& ui) {
  if (!begin_part("facts", ui.layout.facts)) return;
  draw_model_tool(document, ui);
  end_part(ui.areas);
}

}  // namespace mesher::app
