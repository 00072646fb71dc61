#include <imgui.h>

#include <algorithm>
#include <array>
#include <initializer_list>

#include "app/input/command_functions.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/ui/style.h"

namespace mesher::app {
namespace {

constexpr float kButtonPoints = 32.0F;
constexpr const char* kMenus = "menus";

/// Draws into a square, in coordinates from 0 to 1 with y down.
class Icon {
 public:
  Icon(ImVec2 least, ImVec2 most) : least_(least), side_(most.x - least.x, most.y - least.y) {}

  void path(std::initializer_list<ImVec2> points, float weight = 1.6F) const {
    for (auto point = points.begin(); point + 1 < points.end(); ++point)
      list_->AddLine(at(point[0]), at(point[1]), color_, units(weight));
  }
  void circle(ImVec2 center, float radius, bool is_filled = false) const {
    if (is_filled) {
      list_->AddCircleFilled(at(center), radius * side_.x, color_);
    } else {
      list_->AddCircle(at(center), radius * side_.x, color_, 0, units(1.6F));
    }
  }

 private:
  ImVec2 at(ImVec2 p) const { return {least_.x + p.x * side_.x, least_.y + p.y * side_.y}; }

  ImDrawList* list_ = ImGui::GetWindowDrawList();
  ImU32 color_ = ImGui::GetColorU32(ImGuiCol_Text);
  ImVec2 least_;
  ImVec2 side_;
};

void draw_icon(Tool tool, const Icon& icon) {
  switch (tool) {
    case Tool::model:  // an i in a circle
      icon.circle({0.5F, 0.5F}, 0.3F);
      icon.circle({0.5F, 0.37F}, 0.045F, true);
      return icon.path({{0.5F, 0.46F}, {0.5F, 0.66F}});
    case Tool::look:  // an eye
      icon.path({{0.16F, 0.5F},
                 {0.34F, 0.33F},
                 {0.66F, 0.33F},
                 {0.84F, 0.5F},
                 {0.66F, 0.67F},
                 {0.34F, 0.67F},
                 {0.16F, 0.5F}});
      return icon.circle({0.5F, 0.5F}, 0.11F, true);
    case Tool::simplify:  // two vertices move into one
      icon.path({{0.16F, 0.5F}, {0.4F, 0.5F}, {0.32F, 0.42F}});
      icon.path({{0.4F, 0.5F}, {0.32F, 0.58F}});
      icon.path({{0.84F, 0.5F}, {0.6F, 0.5F}, {0.68F, 0.42F}});
      icon.path({{0.6F, 0.5F}, {0.68F, 0.58F}});
      return icon.path({{0.5F, 0.22F}, {0.5F, 0.78F}});
    case Tool::subdivide:  // a face in four
      icon.path({{0.5F, 0.2F}, {0.82F, 0.76F}, {0.18F, 0.76F}, {0.5F, 0.2F}});
      return icon.path({{0.34F, 0.48F}, {0.66F, 0.48F}, {0.5F, 0.76F}, {0.34F, 0.48F}});
    case Tool::creases:  // a ridge
      icon.path({{0.2F, 0.72F}, {0.5F, 0.28F}, {0.8F, 0.72F}}, 1.2F);
      return icon.path({{0.5F, 0.26F}, {0.5F, 0.8F}}, 3.0F);
    case Tool::levels:  // bars of growing length
      icon.path({{0.26F, 0.76F}, {0.26F, 0.6F}}, 4.0F);
      icon.path({{0.5F, 0.76F}, {0.5F, 0.44F}}, 4.0F);
      return icon.path({{0.74F, 0.76F}, {0.74F, 0.24F}}, 4.0F);
  }
}

bool icon_button(const char* name, float side, bool is_chosen, const std::string& help) {
  if (is_chosen)
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
  const std::string id = std::string("##") + name;
  const bool is_pressed = ImGui::Button(id.c_str(), {side, side});
  if (is_chosen) ImGui::PopStyleColor();
  note_widget(name);
  tooltip(help.c_str());
  return is_pressed;
}

/// The menus, where there is no menu bar.
void draw_menu_button(const Session& session, float side, Ui& ui) {
  if (icon_button(kMenus, side, false, "Menus")) ImGui::OpenPopup(kMenus);
  const Icon icon(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
  for (const float y : {0.34F, 0.5F, 0.66F})
    icon.path({{0.25F, y}, {0.75F, y}});
  if (!ImGui::BeginPopup(kMenus)) return;
  draw_menus(session, ui);
  ImGui::EndPopup();
}

}  // namespace

void draw_rail(Session& session, Ui& ui) {
  const Rect& place = ui.layout.rail;
  if (!begin_part("rail", place, false)) return;
  const bool has_menu = ui.layout.menu.is_empty();
  const auto buttons = static_cast<float>(kTools.size() + (has_menu ? 1 : 0));
  const float gap = ImGui::GetStyle().ItemSpacing.y;
  const float side = std::max(
      std::min(units(kButtonPoints), (place.height() - units(8.0F)) / buttons - gap), units(4.0F));
  if (has_menu) draw_menu_button(session, side, ui);
  std::size_t number = 0;
  for (const Choice<Tool>& choice : kTools) {
    ++number;
    if (choice.value == Tool::model && ui.layout.width == Layout::Width::full) continue;
    const bool is_chosen = session.shows_info && session.tool == choice.value;
    const std::string help = std::string(choice.text.label) + " (Ctrl+" + std::to_string(number) +
                             "): " + choice.text.help;
    const bool is_pressed = icon_button(choice.text.key, side, is_chosen, help);
    draw_icon(choice.value, {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()});
    if (!is_pressed) continue;
    // Where the panel takes the model's place, a second click closes it.
    const bool closes = is_chosen && ui.layout.width != Layout::Width::full;
    if (closes)
      session.shows_info = false;
    else
      choose_tool(session, choice.value);
  }
  end_part(ui.areas);
}

}  // namespace mesher::app
