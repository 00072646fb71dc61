#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cstdio>

#include "app/progressive_edits.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/words.h"

namespace mesher::app {
namespace {

std::string of_text(std::uint64_t part, std::uint64_t whole) {
  return with_commas(part) + " of " + with_commas(whole);
}

void draw_arrival(ProgressiveView& view) {
  if (!view.is_arriving()) return;
  const std::uint32_t splits = view.mesh().split_count();
  const std::uint32_t announced = std::max(view.reader()->announced_splits(), splits);
  const std::string text = of_text(splits, announced) + " splits";
  ImGui::ProgressBar(announced > 0 ? float(splits) / float(announced) : 1.0F, {-FLT_MIN, 0.0F},
                     text.c_str());
  tooltip("So much of the file has arrived. Esc: no more of it.");
}

/// Applies while it is dragged.
void draw_slider(ProgressiveView& view) {
  auto position = static_cast<float>(view.position());
  const std::string text = with_commas(view.mesh().mesh().face_count()) + " faces";
  ImGui::SetNextItemWidth(-FLT_MIN);
  constexpr ImGuiSliderFlags kFlags =
      ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput | ImGuiSliderFlags_NoRoundToFormat;
  if (ImGui::SliderFloat("##detail", &position, 0.0F, 1.0F, text.c_str(), kFlags)) {
    view.move_to(position);
  }
  tooltip(
      "From the base to all the detail, by the logarithm of the size.\n"
      "PageUp, PageDown: a tenth; [ and ]: one split; Home, End: the ends.");
}

void draw_buttons(Session& session, bool is_busy) {
  ProgressiveView& view = session.progressive;
  if (half_button(view.is_playing() ? "pause###play" : "play###play", true,
                  "Space: to and fro between the ends.")) {
    view.play(!view.is_playing());
  }
  ImGui::SameLine();
  if (half_button("keep this level", !is_busy && !view.is_arriving(),
                  "K: this level becomes the model, which can be edited, and leaves the mode.\n"
                  "Undo brings back the model.")) {
    request_keep_level(session);
  }
}

void draw_numbers(const ProgressiveView& view) {
  const ProgressiveMesh& mesh = view.mesh();
  label("faces");
  ImGui::TextUnformatted(of_text(mesh.mesh().face_count(), mesh.full_face_count()).c_str());
  label("splits");
  ImGui::TextUnformatted(of_text(mesh.level(), mesh.split_count()).c_str());
}

void draw_growth(const ProgressiveView& view, ProgressiveSettings& settings) {
  label("geomorphs");
  ImGui::BeginDisabled(!view.has_geomorph());
  ImGui::Checkbox("##geomorphs", &settings.geomorphs);
  tooltip("Shift+G: splits grow as the slider moves. Off: they pop.");
  ImGui::EndDisabled();
  label("window");
  ImGui::BeginDisabled(!settings.geomorphs || !view.has_geomorph());
  float percent = 100.0F * settings.geomorph_range;
  constexpr float kMost = 100.0F * float(DetailRange::kMaxGeomorphRange);
  if (ImGui::SliderFloat("##window", &percent, 0.1F, kMost, "%.1f %%",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
    settings.geomorph_range = percent / 100.0F;
  }
  tooltip("How many splits grow at a time, as a share of the vertices that there are by then.");
  ImGui::EndDisabled();
  label("play takes");
  ImGui::SliderFloat("##seconds", &settings.seconds, 1.0F, 60.0F, "%.1f s",
                     ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  tooltip("From one end to the other.");
  label("births");
  ImGui::Checkbox("colors##births", &settings.colors_by_split_order);
  tooltip("Shift+B: from violet to yellow, the later a vertex came.");
}

void draw_automatic(const Session& session, ProgressiveSettings& settings) {
  const ProgressiveView& view = session.progressive;
  ImGui::BeginDisabled(!view.has_geomorph());
  label("automatic");
  ImGui::Checkbox("by size##automatic", &settings.is_automatic);
  tooltip("A: the coarsest level that is off by no more than the tolerance, as it is seen.");
  label("tolerance");
  ImGui::SliderFloat("##tolerance", &settings.tolerance_px, 0.1F, 20.0F, "%.2f pixels",
                     ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  if (view.has_geomorph()) {
    label("off by");
    const double error = view.levels().errors.error(view.mesh().level());
    ImGui::Text("%.3g pixels", error * shown_pixels_a_unit(session));
    tooltip("An estimate: the farthest that any split to come moves the surface.");
  }
  ImGui::EndDisabled();
}

/// Why the base is what it is, where that is not what was asked for.
void draw_report(const Session& session) {
  const auto& report = session.progressive.levels().report;
  if (!report) return;
  const SimplifyOutcome base{*report, session.statistics.box.diagonal(), {}};
  label("base error");
  ImGui::TextUnformatted(percent_text(base.error_percent()).c_str());
  tooltip("Estimated RMS distance from the model, in percent of the diagonal.");
  if (report->reason == StopReason::target_reached && !base.is_far()) return;
  const std::string words =
      base.is_far() ? far_from("the model", base.error_percent()) : stop_text(report->reason);
  ImGui::TextWrapped("%s", words.c_str());
}

/// A base of another size, where there is a model to make it of.
void draw_base(Session& session, ProgressiveSettings& settings, bool is_busy) {
  ProgressiveView& view = session.progressive;
  if (view.levels().vertex_source.empty()) {
    label("base");
    return ImGui::TextUnformatted((with_commas(view.mesh().base_face_count()) + " faces").c_str());
  }
  label("base");
  bool is_chosen = settings.base_faces == 0;
  if (ImGui::Checkbox("by size and error##base", &is_chosen)) {
    settings.base_faces = is_chosen ? 0 : view.mesh().base_face_count();
  }
  tooltip(
      "The base has 200 faces, or an eighth of a small model; it stops earlier where it would\n"
      "be further than 5 % of the diagonal from the model. Off: as many faces as you say.");
  label("base faces");
  ImGui::BeginDisabled(is_chosen);
  auto faces = static_cast<int>(is_chosen ? view.mesh().base_face_count() : settings.base_faces);
  constexpr int kMost = 100'000'000;
  if (ImGui::InputInt("##base", &faces, 100, 1000) && !is_chosen) {
    settings.base_faces = static_cast<std::uint32_t>(std::clamp(faces, 1, kMost));
  }
  ImGui::EndDisabled();
  tooltip("How far simplification goes, by the rules of its panel.");
  draw_report(session);
  ImGui::BeginDisabled(is_busy);
  if (ImGui::Button("make it anew", {-FLT_MIN, 0.0F})) {
    view.change(settings);
    request_edit(session, {.kind = EditRequest::Kind::progressive, .rebuilds = true});
  }
  ImGui::EndDisabled();
}

}  // namespace

float draw_progressive_panel(Session& session, const PanelFacts& facts, float top,
                             PanelAreas& areas) {
  ProgressiveView& view = session.progressive;
  bool is_open = true;
  if (begin_side_panel("Progressive mesh", top, &is_open)) {
    const bool is_busy = facts.job != nullptr;
    draw_arrival(view);
    draw_slider(view);
    draw_buttons(session, is_busy);
    draw_numbers(view);
    ProgressiveSettings settings = view.settings();
    ImGui::Separator();
    draw_growth(view, settings);
    ImGui::Separator();
    draw_automatic(session, settings);
    ImGui::Separator();
    label("uploaded");
    ImGui::TextUnformatted(
        (size_text(facts.upload.uploaded_bytes) + " of " + size_text(facts.upload.total_bytes))
            .c_str());
    tooltip("By the last step that moved anything to the GPU, of all that is there.");
    draw_base(session, settings, is_busy);
    view.change(settings);
  }
  const float bottom = end_side_panel(areas);
  if (!is_open) toggle_progressive(session);
  return bottom;
}

}  // namespace mesher::app
