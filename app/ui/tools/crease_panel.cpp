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

std::string sharpness_text(const SelectedSharpness& sharpness) {
  if (sharpness.edges == 0) return "-";
  if (sharpness.is_mixed()) return "mixed";
  return sharpness.most == kInfinitelySharp ? "infinite" : fmt::format("{:.1f}", sharpness.most);
}

/// Applies the sharpness while the slider is dragged. One drag is one step of the history.
void draw_slider(Document& document, const SelectedSharpness& sharpness) {
  CreaseMode& creases = document.creases;
  float value = std::min(sharpness.most, kMaxFiniteSharpness);
  bool is_activated = false;
  const bool is_changed =
      edit_slider("sharpness", value, {0.0F, kMaxFiniteSharpness, false, &is_activated},
                  sharpness_text(sharpness),
                  "Number of subdivision steps for which the edges stay sharp. + and - change it "
                  "by 1.");
  if (is_activated) ++creases.drags;
  if (!is_changed) return;
  creases.finite_sharpness = value;
  request_crease_edit(document,
                      {.kind = CreaseRequest::Kind::set, .value = value, .drag = creases.drags});
}

void draw_infinite(Document& document, const SelectedSharpness& sharpness) {
  bool is_infinite = sharpness.edges > 0 && sharpness.least == kInfinitelySharp;
  label("");
  if (ImGui::Checkbox("infinite", &is_infinite)) {
    const float value = is_infinite ? kInfinitelySharp : document.creases.finite_sharpness;
    request_crease_edit(document, {.kind = CreaseRequest::Kind::set, .value = value});
  }
  note_widget("infinite");
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

void draw_angle(Document& document) {
  float& angle = document.creases.tag_angle_deg;
  edit_slider("angle", angle, {0.0F, 180.0F}, fmt::format("{:.0f} deg", angle),
              "Minimum angle between the face normals of the edges to mark.");
}

void draw_tagging(Document& document, TagCount& last) {
  const std::uint32_t edges = count_untagged(document, last);
  const std::string text = fmt::format("mark {} by angle###tag", count_text(edges, "edge"));
  if (wide_button(text.c_str(), edges > 0, "Shift+C: mark these edges as infinitely sharp.")) {
    request_crease_edit(document, {.kind = CreaseRequest::Kind::tag_by_angle,
                                   .value = document.creases.tag_angle_deg});
  }
}

void draw_rules(Document& document, const SelectedSharpness& sharpness) {
  heading("Rules");
  ImGui::BeginDisabled(sharpness.edges == 0);
  draw_slider(document, sharpness);
  draw_infinite(document, sharpness);
  ImGui::EndDisabled();
  draw_angle(document);
}

void draw_switch(Document& document) {
  bool is_on = document.creases.is_on;
  label("select edges");
  if (ImGui::Checkbox("by clicks##creases", &is_on)) set_crease_mode(document, is_on);
  note_widget("select edges");
  tooltip("C: a click on the model selects the edge under the cursor.");
}

}  // namespace

void draw_crease_tool(Document& document, Block block, Ui& ui) {
  const SelectedSharpness sharpness = selected_sharpness(document.model.mesh, document.creases);
  switch (block) {
    case Block::settings:
      heading("Target");
      draw_switch(document);
      draw_counts(document.creases, document.statistics);
      ImGui::BeginDisabled(ui.facts.job != nullptr);  // the job may change the edges
      draw_rules(document, sharpness);
      ImGui::EndDisabled();
      return;
    case Block::apply:
      ImGui::BeginDisabled(ui.facts.job != nullptr);
      heading("Apply");
      draw_clear_buttons(document, sharpness);
      draw_tagging(document, ui.tag_count);
      ImGui::EndDisabled();
      return;
    case Block::result:
      return;  // the model shows it, and the history says it
  }
}

}  // namespace mesher::app
