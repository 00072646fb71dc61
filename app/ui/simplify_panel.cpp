#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>

#include "app/edit/edits.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

void draw_rules(SimplifySettings& settings) {
  edit_options(simplify::kSimplifyRules, settings.rules);
  edit_options(kSimplifyLimits, settings);
}

/// Simplifies when the slider is released. If the model has more faces than it was opened with, the
/// slider is at its right end.
void draw_target(Document& document, bool is_busy, int& slider_faces) {
  const auto most = static_cast<int>(document.edits.opened_faces);
  const int fewest = std::min(document.statistics.is_closed() ? 4 : 1, most);
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::SliderInt("##faces", &slider_faces, fewest, std::max(most, fewest + 1), "%d faces",
                   ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  tooltip(
      "Release to simplify the opened model to this number of faces. Drag to the right to restore\n"
      "detail, up to that of the opened model. Detail that a subdivision added is lost.");
  if (ImGui::IsItemDeactivatedAfterEdit()) {
    request_simplify_to(document, static_cast<std::uint32_t>(slider_faces));
  } else if (!ImGui::IsItemActive() && !is_busy && document.edits.waiting.empty()) {
    slider_faces =
        std::min(static_cast<int>(document.statistics.faces), std::max(most, fewest + 1));
  }
}

void draw_buttons(Document& document) {
  const History& history = document.edits.history;
  const bool has_faces = document.statistics.faces > 0;
  const bool can_undo = history.undo_depth() > 0;
  const bool can_redo = history.redo_depth() > 0;
  const std::string undo_help = can_undo ? "Ctrl+Z: " + history.undo_name() : "nothing to undo";
  const std::string redo_help =
      can_redo ? "Ctrl+Shift+Z: " + history.redo_name() : "nothing to redo";
  if (half_button("remove 10 %", has_faces, "D")) request_remove_tenth(document);
  ImGui::SameLine();
  if (half_button("one edge", has_faces, "Shift+D")) request_collapse_edge(document);
  if (half_button("undo", can_undo, undo_help.c_str())) request_undo(document);
  ImGui::SameLine();
  if (half_button("redo", can_redo, redo_help.c_str())) request_redo(document);
}

std::string error_text(const SimplifyOutcome& outcome, double error) {
  return fmt::format("{} ({})", number_text(error), percent_text(outcome.percent(error)));
}

void draw_report(const SimplifyOutcome& outcome) {
  const simplify::SimplifyReport& report = outcome.report;
  if (!ImGui::BeginTable("report", 2, ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, kFieldX - 20.0F);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  row("target", report.faces_asked > 0 ? count_text(report.faces_asked) : "no face target");
  row("result",
      fmt::format("{} of {}", count_text(report.faces_reached), count_text(report.faces_before)));
  row("why it stopped", std::string(describe(report.reason)));
  row("collapses", count_text(report.collapses));
  for (std::size_t i = 0; i < simplify::kRejections.size(); ++i) {
    const auto cause = static_cast<simplify::Rejection>(i);
    if (report[cause] == 0) continue;
    row("refused", fmt::format("{} by {}", count_text(report[cause]), describe(cause)));
  }
  row("error, RMS", error_text(outcome, report.estimated_error));
  tooltip("Estimate of the RMS distance from the input.");
  if (report.measured_error >= 0.0) {
    row("error, max", error_text(outcome, report.measured_error));
    tooltip("The largest measured distance, in both directions.");
  }
  if (outcome.error_from_opened) {
    row("error, total", error_text(outcome, *outcome.error_from_opened));
    tooltip("RMS distance from the opened model, measured at sample points.");
  }
  if (outcome.is_far()) {
    row("warning", "far from the opened model");
    tooltip(
        "The error is more than 5 % of the diagonal. To keep the shape, undo or ask for more\n"
        "faces.");
  }
  row("preparation", seconds_text(report.seconds.prepare));
  row("collapsing", seconds_text(report.seconds.collapse));
  row("completion", seconds_text(report.seconds.finish));
  if (report.measured_error >= 0.0) row("measurement", seconds_text(report.seconds.measure));
  for (const std::string& dropped : outcome.dropped)
    row("dropped", dropped);
  ImGui::EndTable();
}

}  // namespace

void draw_simplify_panel(Document& document, const PanelFacts& facts, float top, int& slider_faces,
                         PanelAreas& areas) {
  if (begin_side_panel("Simplify", top)) {
    ImGui::BeginDisabled(document.statistics.faces == 0);
    draw_target(document, facts.job != nullptr, slider_faces);
    ImGui::EndDisabled();
    draw_buttons(document);
    ImGui::Separator();
    draw_rules(document.simplify);
    if (document.edits.last) {
      ImGui::Separator();
      draw_report(*document.edits.last);
    }
  }
  end_side_panel(areas);
}

}  // namespace mesher::app
