#include <imgui.h>

#include <algorithm>
#include <cfloat>

#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/words.h"

namespace mesher::app {
namespace {

// In the order of the enums.
constexpr Choice kCosts[kCostPolicyCount] = {
    {"quadric",
     "The smallest distance to the input: squared distance to the planes of the faces\n"
     "as they are now, weighted by area, volume kept. The default."},
    {"accumulated quadric",
     "The classic of Garland and Heckbert, for comparison: quadrics gathered\n"
     "along all collapses."},
    {"edge length", "Even spacing: the shortest edge goes first, at the price of accuracy."},
    {"triangle shape",
     "Triangles as near to equilateral as can be, for meshes that something\n"
     "is computed on."},
    {"random", "Any legal edge, all equally likely: a baseline for the others."}};
constexpr Choice kPlacements[kPlacementCount] = {
    {"optimal", "The vertex that two become goes where the cost is least."},
    {"midpoint", "It goes to the middle of the edge."},
    {"endpoint", "It stays at the end that costs less: positions remain a subset of the input's."}};
constexpr Choice kBoundaries[] = {
    {"preserve", "Boundary loops stay loops, and are simplified along themselves."},
    {"lock", "No vertex on a boundary moves or vanishes."}};

void draw_rules(SimplifySettings& settings) {
  choose("cost", kCosts, settings.cost);
  choose("placement", kPlacements, settings.placement);
  choose("boundary", kBoundaries, settings.boundary);
  label("crease angle");
  ImGui::SliderFloat("##crease angle", &settings.crease_angle_deg, 0.0F, 180.0F,
                     settings.crease_angle_deg < 180.0F ? "%.0f deg" : "tagged only",
                     ImGuiSliderFlags_AlwaysClamp);
  tooltip("Edges whose faces turn by more count as creases, besides those that are tagged.");
  label("max error");
  ImGui::DragFloat("##max error", &settings.max_error_percent, 0.002F, 0.0F, 100.0F,
                   settings.max_error_percent > 0.0F ? "%.3f %%" : "no bound",
                   ImGuiSliderFlags_AlwaysClamp);
  tooltip(
      "No step may lead further than this from what it starts from, in percent of the diagonal;\n"
      "the slider starts from the model as it was opened. Drag, or Ctrl+click to type; 0: no\n"
      "bound. With a bound it takes thirty times as long and more.");
  ImGui::BeginDisabled(settings.cost != CostPolicy::random);
  label("seed");
  int seed = static_cast<int>(settings.seed);
  if (ImGui::InputInt("##seed", &seed))
    settings.seed = static_cast<std::uint32_t>(std::max(seed, 0));
  tooltip("Of the random policy: the same seed gives the same mesh.");
  ImGui::EndDisabled();
}

/// Applies on release, since dragging passes through everything in between. Where the model is
/// shown in more detail than it was opened in, the slider stands at its right end.
void draw_target(Session& session, bool is_busy, int& slider_faces) {
  const auto most = static_cast<int>(session.edits.opened_faces);
  const int fewest = std::min(session.statistics.is_closed() ? 4 : 1, most);
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::SliderInt("##faces", &slider_faces, fewest, std::max(most, fewest + 1), "%d faces",
                   ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  tooltip(
      "Simplifies the model as it was opened to so many faces, when let go:\n"
      "to the right, detail comes back, up to what was opened. What a subdivision\n"
      "added beyond that is not kept.");
  if (ImGui::IsItemDeactivatedAfterEdit()) {
    request_edit(session,
                 {EditRequest::Kind::simplify_to, static_cast<std::uint32_t>(slider_faces)});
  } else if (!ImGui::IsItemActive() && !is_busy && session.edits.waiting.empty()) {
    slider_faces = std::min(static_cast<int>(session.statistics.faces), std::max(most, fewest + 1));
  }
}

void request_button(Session& session, const char* name, EditRequest::Kind kind, bool is_possible,
                    const std::string& help) {
  if (half_button(name, is_possible, help.c_str())) request_edit(session, {kind});
}

void draw_buttons(Session& session) {
  const History& history = session.edits.history;
  const bool has_faces = session.statistics.faces > 0;
  const bool can_undo = history.undo_depth() > 0;
  const bool can_redo = history.redo_depth() > 0;
  request_button(session, "remove 10 %", EditRequest::Kind::remove_tenth, has_faces, "D");
  ImGui::SameLine();
  request_button(session, "one edge", EditRequest::Kind::remove_edge, has_faces, "Shift+D");
  request_button(session, "undo", EditRequest::Kind::undo, can_undo,
                 can_undo ? "Ctrl+Z: " + history.undo_name() : "nothing to undo");
  ImGui::SameLine();
  request_button(session, "redo", EditRequest::Kind::redo, can_redo,
                 can_redo ? "Ctrl+Shift+Z: " + history.redo_name() : "nothing to redo");
}

std::string error_text(const SimplifyOutcome& outcome, double error) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3g (%.3g %%)", error, outcome.percent(error));
  return text;
}

void draw_ledger(const SimplifyOutcome& outcome) {
  const SimplifyReport& report = outcome.report;
  if (!ImGui::BeginTable("ledger", 2, ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, kFieldX - 20.0F);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  row("asked", report.faces_asked > 0 ? with_commas(report.faces_asked) : "as few as go");
  row("reached", with_commas(report.faces_reached) + " of " + with_commas(report.faces_before));
  row("ended", std::string(describe(report.reason)));
  row("collapses", with_commas(report.collapses));
  for (std::size_t i = 0; i < kRejectionCount; ++i) {
    const auto cause = static_cast<Rejection>(i);
    if (report[cause] == 0) continue;
    row("refused", with_commas(report[cause]) + " by " + std::string(describe(cause)));
  }
  row("error, est.", error_text(outcome, report.estimated_error));
  tooltip("An estimate of the RMS distance to the input, from the costs paid.");
  if (report.measured_error >= 0.0) {
    row("error, max", error_text(outcome, report.measured_error));
    tooltip("The largest distance that was measured, both ways.");
  }
  if (outcome.error_from_opened) {
    row("from opened", error_text(outcome, *outcome.error_from_opened));
    tooltip("RMS distance from the model as it was opened, measured at some points.");
  }
  if (outcome.is_far()) {
    row("warning", "far from what was opened");
    tooltip("Further than 5 % of the diagonal: undo, or ask for more faces, to keep the shape.");
  }
  row("prepared in", seconds_text(report.seconds.prepare));
  row("collapsed in", seconds_text(report.seconds.collapse));
  row("finished in", seconds_text(report.seconds.finish));
  if (report.measured_error >= 0.0) row("measured in", seconds_text(report.seconds.measure));
  for (const std::string& dropped : outcome.dropped)
    row("dropped", dropped);
  ImGui::EndTable();
}

}  // namespace

void draw_simplify_panel(Session& session, const PanelFacts& facts, float top, int& slider_faces,
                         PanelAreas& areas) {
  if (begin_side_panel("Simplify", top)) {
    ImGui::BeginDisabled(session.statistics.faces == 0);
    draw_target(session, facts.job != nullptr, slider_faces);
    ImGui::EndDisabled();
    draw_buttons(session);
    ImGui::Separator();
    draw_rules(session.simplify);
    if (session.edits.last) {
      ImGui::Separator();
      draw_ledger(*session.edits.last);
    }
  }
  end_side_panel(areas);
}

}  // namespace mesher::app
