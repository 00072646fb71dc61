#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <glm/trigonometric.hpp>

#include "app/edit/crease_edits.h"
#include "app/edit/edits.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "engine/core/text.h"
#include "engine/mesh/creases.h"

namespace mesher::app {
namespace {

void draw_counts(const CreaseMode& creases, const Statistics& statistics) {
  label("creases");
  ImGui::TextUnformatted(count_text(statistics.crease_edges).c_str());
  label("selected");
  const std::size_t selected = creases.selected.size();
  if (selected > 0) {
    ImGui::TextUnformatted(count_text(selected).c_str());
  } else {
    ImGui::TextDisabled("click an edge");
  }
  tooltip(
      "Click selects an edge; Shift+click or double click selects its chain of edges.\n"
      "Ctrl+click adds or removes an edge. A click beside the edges clears the selection.\n"
      "Ctrl+A selects all creases.");
}

/// Applies the sharpness while the slider is dragged. One drag is one step of the history.
void draw_slider(Document& document, const SelectedSharpness& sharpness) {
  const char* format = "%.1f";
  if (sharpness.edges == 0) {
    format = "-";
  } else if (sharpness.is_mixed()) {
    format = "mixed";
  } else if (sharpness.most == kInfinitelySharp) {
    format = "infinite";
  }
  CreaseMode& creases = document.creases;
  float value = std::min(sharpness.most, kMaxFiniteSharpness);
  label("sharpness");
  const bool is_changed = ImGui::SliderFloat("##sharpness", &value, 0.0F, kMaxFiniteSharpness,
                                             format, ImGuiSliderFlags_AlwaysClamp);
  if (ImGui::IsItemActivated()) ++creases.drags;
  if (is_changed) {
    creases.finite_sharpness = value;
    request_crease_edit(document,
                        {.kind = CreaseRequest::Kind::set, .value = value, .drag = creases.drags});
  }
  tooltip("Number of subdivision steps for which the edges stay sharp. + and - change it by 1.");
}

void draw_infinite(Document& document, const SelectedSharpness& sharpness) {
  bool is_infinite = sharpness.edges > 0 && sharpness.least == kInfinitelySharp;
  label("");
  if (ImGui::Checkbox("infinite", &is_infinite)) {
    const float value = is_infinite ? kInfinitelySharp : document.creases.finite_sharpness;
    request_crease_edit(document, {.kind = CreaseRequest::Kind::set, .value = value});
  }
  tooltip("I: make the selected edges infinitely sharp.");
}

void draw_clear_buttons(Document& document, const SelectedSharpness& sharpness) {
  if (half_button("clear selected", sharpness.most > 0.0F,
                  "X or Delete: make the selected edges smooth.")) {
    request_crease_edit(document, {.kind = CreaseRequest::Kind::set, .value = 0.0F});
  }
  ImGui::SameLine();
  if (half_button("clear all", document.statistics.crease_edges > 0, "Make all edges smooth.")) {
    request_crease_edit(document, {.kind = CreaseRequest::Kind::clear_all});
  }
}

/// Counts again only if the answer may have changed, because the count visits every edge.
std::uint32_t count_untagged(const Document& document, TagCount& last) {
  const TagCount now{document.model_generation, document.edits.revision,
                     document.creases.tag_angle_deg};
  if (now.generation != last.generation || now.revision != last.revision ||
      now.angle_deg != last.angle_deg) {
    last = now;
    const float angle_rad = glm::radians(now.angle_deg);
    last.edges =
        static_cast<std::uint32_t>(untagged_edges_beyond(document.model.mesh, angle_rad).size());
  }
  return last.edges;
}

void draw_tagging(Document& document, TagCount& last) {
  label("angle");
  ImGui::SliderFloat("##tag angle", &document.creases.tag_angle_deg, 0.0F, 180.0F, "%.0f deg",
                     ImGuiSliderFlags_AlwaysClamp);
  tooltip("Minimum angle between the face normals of the edges to mark.");
  const std::uint32_t edges = count_untagged(document, last);
  ImGui::BeginDisabled(edges == 0);
  const std::string text = fmt::format("mark {} by angle###tag", count_text(edges, "edge"));
  if (ImGui::Button(text.c_str(), {-FLT_MIN, 0.0F})) {
    request_crease_edit(document, {.kind = CreaseRequest::Kind::tag_by_angle,
                                   .value = document.creases.tag_angle_deg});
  }
  ImGui::EndDisabled();
  tooltip("Shift+C: mark these edges as infinitely sharp.");
}

}  // namespace

float draw_crease_panel(Document& document, const PanelFacts& facts, float top, TagCount& last,
                        PanelAreas& areas) {
  bool is_open = true;
  if (begin_side_panel("Edit creases", top, &is_open)) {
    draw_counts(document.creases, document.statistics);
    const SelectedSharpness sharpness = selected_sharpness(document.model.mesh, document.creases);
    ImGui::BeginDisabled(facts.job != nullptr);  // the job may change the edges
    ImGui::BeginDisabled(sharpness.edges == 0);
    draw_slider(document, sharpness);
    draw_infinite(document, sharpness);
    ImGui::EndDisabled();
    draw_clear_buttons(document, sharpness);
    ImGui::Separator();
    draw_tagging(document, last);
    ImGui::EndDisabled();
  }
  const float bottom = end_side_panel(areas);
  if (!is_open) set_crease_mode(document, false);
  return bottom;
}

}  // namespace mesher::app
