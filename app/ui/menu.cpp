#include <imgui.h>

#include "app/input/commands.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"

namespace mesher::app {
namespace {

constexpr const char* kContext = "context";

void draw_item(const Session& session, const Command& command, Ui& ui) {
  const char* reason = blocked(session, command);
  const std::string keys = keys_text(command);
  if (ImGui::MenuItem(command.label, keys.c_str(), is_on(session, command), reason == nullptr))
    ui.chosen = &command;
  note_widget(command.id);
  tooltip(reason != nullptr ? reason : command.help);
}

void draw_group(const Session& session, CommandGroup group, Ui& ui) {
  for (const Command& command : commands()) {
    if (command.group == group) draw_item(session, command, ui);
  }
}

CommandGroup group_of(Tool tool) {
  switch (tool) {
    case Tool::model:
      return CommandGroup::edit;
    case Tool::look:
      return CommandGroup::look;
    case Tool::simplify:
      return CommandGroup::simplify;
    case Tool::subdivide:
      return CommandGroup::subdivide;
    case Tool::creases:
      return CommandGroup::creases;
    case Tool::levels:
      return CommandGroup::progressive;
  }
  return CommandGroup::look;
}

}  // namespace

void draw_menus(const Session& session, Ui& ui) {
  for (const Choice<CommandGroup>& group : kCommandGroups) {
    const bool is_open = ImGui::BeginMenu(group.text.label);
    if (!is_open) note_widget(std::string("menu ") + group.text.key);
    if (!is_open) continue;
    draw_group(session, group.value, ui);
    ImGui::EndMenu();
    note_widget(std::string("menu ") + group.text.key);
  }
}

void draw_menu_bar(Session& session, Ui& ui) {
  if (ui.layout.menu.is_empty()) return;
  ImGui::PushStyleVar(
      ImGuiStyleVar_FramePadding,
      {ImGui::GetStyle().FramePadding.x, 0.5F * (ui.layout.menu.height() - ImGui::GetFontSize())});
  if (ImGui::BeginMainMenuBar()) {
    draw_menus(session, ui);
    note_area(ui.areas);
    ImGui::EndMainMenuBar();
  }
  ImGui::PopStyleVar();
}

void draw_context_menu(Session& session, Ui& ui) {
  if (session.wants_context_menu) ImGui::OpenPopup(kContext);
  session.wants_context_menu = false;
  if (!ImGui::BeginPopup(kContext)) return;
  draw_group(session, group_of(session.tool), ui);
  ImGui::Separator();
  draw_menus(session, ui);
  ImGui::EndPopup();
}

}  // namespace mesher::app
