#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/edit/edits.h"
#include "app/edit/simplify_edit.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

void draw_rules(SimplifySettings& settings) {
  edit_options(simplify::kSimplifyRules, settings.rules);
  edit_options(kSimplifyLimits, settings);
}

/// The number of faces to simplify to: at first half of those of the opened model.
void draw_target(const Document& document, Ui& ui) {
  if (ui.target_of != document.opening) {
    ui.target_of = document.opening;
    ui.target_faces = std::max(document.edits.opened_faces / 2, 1U);
  }
  edit_count("faces", ui.target_faces,
             "Number of faces to simplify the opened model to. Leave it empty to stop at the max "
             "error alone.\n--faces",
             "no target");
  const auto opened = static_cast<float>(std::max(document.edits.opened_faces, 1U));
  const bool has_target = ui.target_faces > 0;
  float percent = std::min(100.0F * static_cast<float>(ui.target_faces) / opened, 100.0F);
  if (edit_slider("ratio", percent, {0.1F, 100.0F, true}, has_target ? percent_text(percent) : "-",
                  "The same as a share of the opened model's faces.\n--ratio")) {
    ui.target_faces =
        std::max(static_cast<std::uint32_t>(std::lround(0.01F * percent * opened)), 1U);
  }
}

/// Returns "simplify to 500 faces", or "simplify to max error 0.5 %".
std::string button_text(const Document& document, std::uint32_t faces) {
  if (faces > 0) return "simplify to " + count_text(faces, "face");
  return document.simplify.max_error_percent > 0.0F ? "simplify to " + bound_text(document.simplify)
                                                    : "simplify";
}

void draw_buttons(Document& document, const Ui& ui) {
  const bool has_faces = document.statistics.faces > 0;
  const bool has_target = ui.target_faces > 0 || document.simplify.max_error_percent > 0.0F;
  const std::string text = button_text(document, ui.target_faces) + "###simplify";
  if (wide_button(text.c_str(), has_faces && has_target,
                  has_target
                      ? "Starts from the opened model, so that detail can also be restored.\n"
                        "Detail that a subdivision added is lost."
                      : "Give a number of faces, or a max error.")) {
    request_simplify_to(document, ui.target_faces);
  }
  if (half_button("remove 10 %", has_faces, "D")) request_remove_tenth(document);
  ImGui::SameLine();
  if (half_button("one edge", has_faces, "Shift+D: collapse the edge of the least cost."))
    request_collapse_edge(document);
}

std::string error_text(const SimplifyOutcome& outcome, double error) {
  return fmt::format("{} ({})", number_text(error), percent_text(outcome.percent(error)));
}

void draw_report(const SimplifyOutcome& outcome) {
  const simplify::SimplifyReport& report = outcome.report;
  if (!begin_rows("report")) return;
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
  if (outcome.crosses_seams) row("seams", "crossed to reach the target");
  ImGui::EndTable();
}

}  // namespace

void draw_simplify_tool(Document& document, Block block, Ui& ui) {
  switch (block) {
    case Block::settings:
      heading("Target");
      draw_target(document, ui);
      heading("Rules");
      return draw_rules(document.simplify);
    case Block::apply:
      heading("Apply");
      return draw_buttons(document, ui);
    case Block::result:
      heading("Result");
      if (const SimplifyOutcome* outcome = document.edits.simplification_outcome())
        return draw_report(*outcome);
      return faint_text("The shown model is not the result of a simplification.");
  }
}

}  // namespace mesher::app
