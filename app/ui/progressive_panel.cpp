#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cstdio>

#include "app/document/shown.h"
#include "app/document/words.h"
#include "app/edit/progressive_edits.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

std::string of_text(std::uint64_t part, std::uint64_t whole) {
  return fmt::format("{} of {}", count_text(part), count_text(whole));
}

void draw_arrival(ProgressiveView& view) {
  if (!view.is_arriving()) return;
  const std::uint32_t splits = view.mesh().split_count();
  const std::uint32_t announced = std::max(view.reader()->announced_splits(), splits);
  const std::string text = of_text(splits, announced) + " splits";
  ImGui::ProgressBar(announced > 0 ? float(splits) / float(announced) : 1.0F, {-FLT_MIN, 0.0F},
                     text.c_str());
  tooltip("Loaded part of the file. Esc: stop loading.");
}

/// Applies the level while the slider is dragged.
void draw_slider(ProgressiveView& view) {
  auto position = static_cast<float>(view.position());
  const std::string text = count_text(view.mesh().mesh().face_count(), "face");
  ImGui::SetNextItemWidth(-FLT_MIN);
  constexpr ImGuiSliderFlags kFlags =
      ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput | ImGuiSliderFlags_NoRoundToFormat;
  if (ImGui::SliderFloat("##detail", &position, 0.0F, 1.0F, text.c_str(), kFlags)) {
    view.move_to(position);
  }
  tooltip(
      "Level of detail, from the base to the full mesh, on a logarithmic scale.\n"
      "PageUp, PageDown: by a tenth. [ and ]: by one split. Home, End: base and full mesh.");
}

void draw_buttons(Document& document, bool is_busy) {
  ProgressiveView& view = document.progressive;
  if (half_button(view.is_playing() ? "pause###play" : "play###play", true,
                  "Space: play back and forth between the base and the full mesh.")) {
    view.play(!view.is_playing());
  }
  ImGui::SameLine();
  if (half_button("use this level", !is_busy && !view.is_arriving(),
                  "K: use this level as the model and leave progressive mode.\n"
                  "Undo restores the model.")) {
    request_keep_level(document);
  }
}

void draw_numbers(const ProgressiveView& view) {
  const progressive::ProgressiveMesh& mesh = view.mesh();
  label("faces");
  ImGui::TextUnformatted(of_text(mesh.mesh().face_count(), mesh.full_face_count()).c_str());
  label("splits");
  ImGui::TextUnformatted(of_text(mesh.level(), mesh.split_count()).c_str());
}

void draw_geomorphs(const ProgressiveView& view, ProgressiveSettings& settings) {
  begin_disabled(!view.has_geomorph());
  edit_option(option_named(kProgressiveOptions, "geomorphs"), settings);
  begin_disabled(!settings.geomorphs);
  edit_option(option_named(kProgressiveOptions, "geomorph-range"), settings);
  end_disabled();
  end_disabled();
  edit_option(option_named(kProgressiveOptions, "seconds"), settings);
  edit_option(option_named(kProgressiveOptions, "split-colors"), settings);
}

/// `pixels_per_unit`: of the model on the screen.
void draw_automatic(const ProgressiveView& view, double pixels_per_unit,
                    ProgressiveSettings& settings) {
  begin_disabled(!view.has_geomorph());
  edit_option(option_named(kProgressiveOptions, "automatic"), settings);
  edit_option(option_named(kProgressiveOptions, "tolerance"), settings);
  if (view.has_geomorph()) {
    label("screen error");
    const double error = view.levels().errors.error(view.mesh().level());
    const double pixels = error * pixels_per_unit;
    ImGui::TextUnformatted(fmt::format("{:.3g} pixels", pixels).c_str());
    tooltip(
        "Estimated screen-space error: the largest distance by which a remaining split moves the "
        "surface.");
  }
  end_disabled();
}

/// The error of the base, and why it stopped before the requested size.
void draw_report(const ProgressiveView& progressive, const Statistics& statistics) {
  const auto& report = progressive.levels().report;
  if (!report) return;
  const SimplifyOutcome base{*report, statistics.box.diagonal(), {}};
  label("base error");
  ImGui::TextUnformatted(percent_text(base.error_percent()).c_str());
  tooltip("Estimated RMS distance from the model, in percent of the diagonal.");
  if (report->reason == simplify::StopReason::target_reached && !base.is_far()) return;
  const std::string words =
      base.is_far() ? far_from("the model", base.error_percent()) : stop_text(report->reason);
  ImGui::TextWrapped("%s", words.c_str());
}

/// The size of the base, and a button to rebuild it if there is a model to build it from.
void draw_base(Document& document, ProgressiveSettings& settings, bool is_busy) {
  ProgressiveView& view = document.progressive;
  if (view.levels().vertex_source.empty()) {
    label("base");
    return ImGui::TextUnformatted(count_text(view.mesh().base_face_count(), "face").c_str());
  }
  label("base");
  bool is_chosen = settings.base_faces == 0;
  if (ImGui::Checkbox("by size and error##base", &is_chosen)) {
    settings.base_faces = is_chosen ? 0 : view.mesh().base_face_count();
  }
  tooltip(
      "The base has 200 faces, or an eighth of a small model; more if it would otherwise be\n"
      "further than 5 % of the diagonal from the model. Off: set the number of faces below.");
  label("base faces");
  ImGui::BeginDisabled(is_chosen);
  auto faces = static_cast<int>(is_chosen ? view.mesh().base_face_count() : settings.base_faces);
  constexpr int kMost = 100'000'000;
  if (ImGui::InputInt("##base", &faces, 100, 1000) && !is_chosen) {
    settings.base_faces = static_cast<std::uint32_t>(std::clamp(faces, 1, kMost));
  }
  ImGui::EndDisabled();
  tooltip("Number of faces of the base. The rules are those of the Simplify panel.");
  draw_report(document.progressive, document.statistics);
  ImGui::BeginDisabled(is_busy);
  if (ImGui::Button("rebuild", {-FLT_MIN, 0.0F})) {
    view.change(settings);
    request_rebuilt_progressive(document);
  }
  ImGui::EndDisabled();
}

}  // namespace

float draw_progressive_panel(Document& document, const View& view, const PanelFacts& facts,
                             float top, PanelAreas& areas) {
  ProgressiveView& progressive = document.progressive;
  bool is_open = true;
  if (begin_side_panel("Progressive mesh", top, &is_open)) {
    const bool is_busy = facts.job != nullptr;
    draw_arrival(progressive);
    draw_slider(progressive);
    draw_buttons(document, is_busy);
    draw_numbers(progressive);
    ProgressiveSettings settings = progressive.settings();
    ImGui::Separator();
    draw_geomorphs(progressive, settings);
    ImGui::Separator();
    draw_automatic(progressive, shown_pixels_per_unit(document, view), settings);
    ImGui::Separator();
    label("uploaded");
    const std::string text = fmt::format("{} of {}", bytes_text(facts.upload.uploaded_bytes),
                                         bytes_text(facts.upload.total_bytes));
    ImGui::TextUnformatted(text.c_str());
    tooltip("Bytes that the last step uploaded to the GPU, of all bytes of the mesh there.");
    draw_base(document, settings, is_busy);
    progressive.change(settings);
  }
  const float bottom = end_side_panel(areas);
  if (!is_open) toggle_progressive(document);
  return bottom;
}

}  // namespace mesher::app
