#include <fmt/format.h>
#include <imgui.h>

#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/ui/style.h"

namespace mesher::app {
namespace {

constexpr float kSecondColumnPoints = 130.0F;

void draw_shading_choice(render::Settings& settings) {
  using render::Shading;
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::none}) {
    const ChoiceText& text = text_of(shading);
    if (shading != Shading::flat) ImGui::SameLine();
    if (ImGui::RadioButton(text.label, settings.shading == shading)) settings.shading = shading;
    note_widget(text.label);
    tooltip(text.help);
  }
  // Without surface and wireframe the picture would be empty.
  if (settings.shading == Shading::none) settings.wireframe = true;
}

void draw_surface(render::Settings& settings) {
  heading("Surface");
  draw_shading_choice(settings);
  edit_option(option_named(render::kRenderOptions, "look"), settings);
  constexpr const auto& kAngle = option_named(render::kRenderOptions, "crease-angle");
  edit_option(kAngle, settings);
  edit_option(option_named(render::kRenderOptions, "normal-weight"), settings);
  bool is_dark = settings.background == render::Background::dark;
  if (edit_switch("dark", is_dark, "B: dark background and panels.")) {
    settings.background = is_dark ? render::Background::dark : render::Background::light;
  }
}

void draw_lines(render::Settings& settings) {
  heading("Lines");
  begin_disabled(settings.shading == render::Shading::none);
  edit_switch("wireframe", settings.wireframe, "W: edges of all faces.");
  end_disabled();
}

void edit_color(const char* name, render::Color& color) {
  ImGui::ColorEdit3(name, &color.x, ImGuiColorEditFlags_NoInputs);
  note_widget(name);
}

void draw_colors(render::Settings& settings) {
  heading("Colors");
  edit_color("front", settings.front);
  ImGui::SameLine(units(kSecondColumnPoints));
  edit_color("back", settings.back);
  edit_color("crease", settings.crease);
  ImGui::SameLine(units(kSecondColumnPoints));
  edit_color("boundary", settings.boundary);
  if (wide_button("reset colors", true, "Use the colors that mesher starts with.")) {
    const render::Settings fresh;
    settings.front = fresh.front;
    settings.back = fresh.back;
    settings.crease = fresh.crease;
    settings.boundary = fresh.boundary;
  }
}

}  // namespace

void draw_look_tool(View& view) {
  draw_surface(view.settings);
  draw_lines(view.settings);
  draw_colors(view.settings);
  edit_switch("legend", view.shows_legend,
              "explain over the model what its colors and lines stand for: the sharpness of "
              "creases, the split order");
}

}  // namespace mesher::app
