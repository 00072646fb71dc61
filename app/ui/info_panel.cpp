#include <fmt/format.h>
#include <imgui.h>

#include "app/document/shown.h"
#include "app/edit/crease_edits.h"
#include "app/edit/progressive_edits.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

void row_of_count(const char* label, std::int64_t count) {
  row(label, count_text(count));
}

bool begin_table(const char* name) {
  if (!ImGui::BeginTable(name, 2, ImGuiTableFlags_SizingFixedFit)) return false;
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, 130.0F);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  return true;
}

bool begin_section(const char* name) {
  return ImGui::CollapsingHeader(name, ImGuiTreeNodeFlags_DefaultOpen);
}

/// Counts of a level. Collapses change neither the genus nor the number of boundary loops.
void draw_level_counts(const Mesh& mesh, const Statistics& of_model) {
  if (!begin_section("Mesh") || !begin_table("counts")) return;
  row_of_count("vertices", mesh.vertex_count());
  row_of_count("edges", std::int64_t(mesh.vertex_count()) + mesh.face_count() -
                            of_model.euler_characteristic);
  row_of_count("faces", mesh.face_count());
  row_of_count("boundary loops", of_model.boundary_loops);
  row_of_count("components", of_model.components);
  row_of_count("Euler characteristic", of_model.euler_characteristic);
  ImGui::EndTable();
}

void draw_counts(const Statistics& s) {
  if (!begin_section("Mesh") || !begin_table("counts")) return;
  for (const Count& count : kCounts) {
    if (!count.hides_zero || count.of(s) > 0) row_of_count(count.label, count.of(s));
  }
  row("diagonal", number_text(s.box.diagonal()));
  row("area", number_text(s.area));
  if (s.is_closed() && s.faces > 0) row("volume", number_text(s.volume));
  ImGui::EndTable();
}

void draw_repairs(const BuildReport& report) {
  if (!begin_section("Repairs")) return;
  if (report.is_clean()) {
    ImGui::TextDisabled("none needed");
    return;
  }
  for (std::size_t i = 0; i < kRepairs.size(); ++i) {
    const auto repair = static_cast<Repair>(i);
    if (report[repair] == 0) continue;
    const std::string text = fmt::format("{} {}", count_text(report[repair]), describe(repair));
    ImGui::TextWrapped("%s", text.c_str());
  }
}

void draw_shading_choice(render::Settings& settings) {
  using render::Shading;
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::none}) {
    const ChoiceText& text = text_of(shading);
    if (shading != Shading::flat) ImGui::SameLine();
    if (ImGui::RadioButton(text.label, settings.shading == shading)) settings.shading = shading;
    tooltip(text.help);
  }
  // Without surface and wireframe the picture would be empty.
  if (settings.shading == Shading::none) settings.wireframe = true;
}

void draw_look(Document& document, render::Settings& settings) {
  if (!begin_section("Shading")) return;
  draw_shading_choice(settings);
  ImGui::BeginDisabled(settings.shading == render::Shading::none);
  ImGui::Checkbox("wireframe", &settings.wireframe);
  ImGui::EndDisabled();
  ImGui::SameLine(130.0F);
  bool edits_creases = document.creases.is_on;
  if (ImGui::Checkbox("edit creases", &edits_creases)) set_crease_mode(document, edits_creases);
  constexpr const auto& kAngle = option_named(render::kRenderOptions, "crease-angle");
  ImGui::BeginDisabled(!kAngle.applies(settings));
  ImGui::SetNextItemWidth(120.0F);
  ImGui::SliderFloat(kAngle.label, &settings.crease_angle_deg, static_cast<float>(kAngle.least),
                     static_cast<float>(kAngle.most), "%.0f deg", ImGuiSliderFlags_AlwaysClamp);
  tooltip(kAngle.help);
  ImGui::EndDisabled();
  bool is_progressive = document.progressive.is_on();
  if (ImGui::Checkbox("progressive mode", &is_progressive)) toggle_progressive(document);
}

void draw_colors(render::Settings& settings) {
  if (!begin_section("Colors")) return;
  constexpr ImGuiColorEditFlags kFlags = ImGuiColorEditFlags_NoInputs;
  ImGui::ColorEdit3("front", &settings.front.x, kFlags);
  ImGui::SameLine(130.0F);
  ImGui::ColorEdit3("back", &settings.back.x, kFlags);
  ImGui::ColorEdit3("crease", &settings.crease.x, kFlags);
  ImGui::SameLine(130.0F);
  ImGui::ColorEdit3("boundary", &settings.boundary.x, kFlags);
  bool is_dark = settings.background == render::Background::dark;
  if (ImGui::Checkbox("dark background", &is_dark)) {
    settings.background = is_dark ? render::Background::dark : render::Background::light;
  }
  if (ImGui::Button("reset colors")) {
    const render::Settings fresh;
    settings.front = fresh.front;
    settings.back = fresh.back;
    settings.crease = fresh.crease;
    settings.boundary = fresh.boundary;
  }
}

void draw_gpu(const PanelFacts& facts) {
  if (!begin_section("GPU") || !begin_table("gpu")) return;
  if (facts.frame_ms > 0.0) row("frame", seconds_text(1e-3 * facts.frame_ms));
  row("uploaded", bytes_text(facts.upload.uploaded_bytes));
  row("whole mesh", bytes_text(facts.upload.total_bytes));
  ImGui::EndTable();
  ImGui::PushTextWrapPos();
  ImGui::TextDisabled("%s", facts.device.c_str());
  ImGui::PopTextWrapPos();
}

}  // namespace

void draw_info_panel(Document& document, render::Settings& settings, const PanelFacts& facts,
                     bool& is_open, PanelAreas& areas) {
  ImGui::SetNextWindowPos({10.0F, 10.0F}, ImGuiCond_FirstUseEver);
  const float height = ImGui::GetIO().DisplaySize.y - 20.0F;
  ImGui::SetNextWindowSizeConstraints({270.0F, 60.0F}, {270.0F, std::max(height, 80.0F)});
  const std::string title = document.model.name + "###info";
  if (ImGui::Begin(title.c_str(), &is_open, ImGuiWindowFlags_AlwaysAutoResize)) {
    if (document.progressive.is_on()) {
      draw_level_counts(shown_mesh(document), document.statistics);
    } else {
      draw_counts(document.statistics);
    }
    draw_repairs(document.model.report);
    draw_look(document, settings);
    draw_colors(settings);
    draw_gpu(facts);
    ImGui::TextDisabled("F1: all keys");
  }
  note_area(areas);
  ImGui::End();
}

}  // namespace mesher::app
