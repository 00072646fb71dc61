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
    ImGui::TextUnformatted(fmt::format("{:.3g} px", pixels).c_str());
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

/// The size of the base, which can be chosen if there is a model to build it from.
void draw_base(const ProgressiveView& view, ProgressiveSettings& settings) {
  label("base");
  if (view.levels().vertex_source.empty()) {
    return ImGui::TextUnformatted(count_text(view.mesh().base_face_count(), "face").c_str());
  }
  bool is_chosen = settings.base_faces == 0;
  if (ImGui::Checkbox("by size and error##base", &is_chosen)) {
    settings.base_faces = is_chosen ? 0 : view.mesh().base_face_count();
  }
  tooltip(
      "The base has 200 faces, or an eighth of a small model; more if it would otherwise be\n"
      "further than 5 % of the diagonal from the model. Off: set the number of faces below.");
  ImGui::BeginDisabled(is_chosen);
  std::uint32_t faces = is_chosen ? view.mesh().base_face_count() : settings.base_faces;
  constexpr std::uint32_t kMost = 100'000'000;
  if (edit_count("base faces", faces,
                 "Number of faces of the base. The rules are those of the Simplify panel.") &&
      !is_chosen) {
    settings.base_faces = std::clamp(faces, 1U, kMost);
  }
  ImGui::EndDisabled();
}

void draw_start(Document& document, Block block, const Ui& ui) {
  if (block == Block::settings) {
    heading("Target");
    faint_text(
        "A progressive mesh holds all levels of detail from a coarse base to the full model. The "
        "slider below the model moves through them.");
    heading("Rules");
    faint_text("The base follows the rules of the Simplify panel.");
  }
  if (block != Block::apply) return;
  heading("Apply");
  if (wide_button("build levels", ui.facts.job == nullptr && document.statistics.faces > 0,
                  "P: build the progressive mesh and show it.")) {
    toggle_progressive(document);
  }
}

void draw_apply(Document& document, ProgressiveSettings& settings, bool is_busy) {
  ProgressiveView& view = document.progressive;
  if (half_button("use this level", !is_busy && !view.is_arriving(),
                  "K: use this level as the model and leave progressive mode.\n"
                  "Undo restores the model.")) {
    request_keep_level(document);
  }
  ImGui::SameLine();
  if (half_button("leave", !view.is_arriving(), "P: show the model itself.")) {
    toggle_progressive(document);
  }
  if (view.levels().vertex_source.empty()) return;
  if (wide_button("rebuild", !is_busy, "Build the progressive mesh again, by these rules.")) {
    view.change(settings);
    request_rebuilt_progressive(document);
  }
}

void draw_result(const ProgressiveView& view, const Statistics& statistics,
                 const render::UploadStats& upload) {
  if (!view.levels().vertex_source.empty()) draw_report(view, statistics);
  label("uploaded");
  const std::string text =
      fmt::format("{} of {}", bytes_text(upload.uploaded_bytes), bytes_text(upload.total_bytes));
  ImGui::TextUnformatted(text.c_str());
  tooltip("Bytes that the last step uploaded to the GPU, of all bytes of the mesh there.");
}

}  // namespace

void draw_levels_tool(Document& document, const View& view, Block block, Ui& ui) {
  ProgressiveView& progressive = document.progressive;
  if (!progressive.is_on()) return draw_start(document, block, ui);
  ProgressiveSettings settings = progressive.settings();
  switch (block) {
    case Block::settings:
      heading("Target");
      draw_arrival(progressive);
      draw_numbers(progressive);
      draw_automatic(progressive, shown_pixels_per_unit(document, view), settings);
      heading("Rules");
      draw_geomorphs(progressive, settings);
      draw_base(progressive, settings);
      break;
    case Block::apply:
      heading("Apply");
      draw_apply(document, settings, ui.facts.job != nullptr);
      break;
    case Block::result:
      heading("Result");
      draw_result(progressive, document.statistics, ui.facts.upload);
      break;
  }
  progressive.change(settings);
}

}  // namespace mesher::app
