#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>
#include <string>
#include <vector>

#include "app/input/commands.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/ui/style.h"

namespace mesher::app {
namespace {

constexpr float kHelpWidthPoints = 560.0F;

struct MouseHelp {
  const char* gesture;
  const char* what;
};

constexpr MouseHelp kMouse[] = {
    {"drag", "rotate"},
    {"Shift+drag, right drag", "pan"},
    {"wheel", "zoom at the cursor"},
    {"right click", "menu"},
    {"double click", "rotate around the point under the cursor"},
    {"drop a file", "open it"},
    {"click (editing creases)", "select the edge; Ctrl: add or remove it"},
    {"Shift+click, double click", "select the chain of edges"},
};

void draw_row(const std::string& keys, const std::string& what) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(keys.c_str());
  ImGui::PopTextWrapPos();
  ImGui::TableNextColumn();
  ImGui::TextWrapped("%s", what.c_str());
}

bool begin_keys(const char* name) {
  if (!ImGui::BeginTable(name, 2)) return false;
  ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthStretch, 2.0F);
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch, 3.0F);
  return true;
}

void draw_group(const Choice<CommandGroup>& group, const std::vector<const Command*>& found) {
  const auto is_here = [&](const Command* command) { return command->group == group.value; };
  if (std::ranges::none_of(found, is_here)) return;
  heading(group.text.label);
  if (!begin_keys(group.text.key)) return;
  for (const Command* command : found) {
    if (!is_here(command)) continue;
    draw_row(keys_text(*command), command->help);
    note_widget(command->id);
  }
  ImGui::EndTable();
}

void draw_mouse() {
  heading("Mouse");
  if (!begin_keys("mouse")) return;
  for (const MouseHelp& help : kMouse)
    draw_row(help.gesture, help.what);
  ImGui::EndTable();
  faint_text("red: boundary   yellow: crease   bright blue: selected   blue: back of a face");
}

}  // namespace

void draw_help(bool& is_open, Ui& ui) {
  const float height = ImGui::GetIO().DisplaySize.y - units(16.0F);
  ImGui::SetNextWindowSize({0.0F, height});
  if (begin_dialog("Help", &is_open, kHelpWidthPoints)) {
    if (ImGui::IsWindowAppearing()) {
      ui.help_filter.clear();
      ImGui::SetKeyboardFocusHere();
    }
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::InputTextWithHint("##filter", "type to search keys and commands", &ui.help_filter);
    note_text(ui.help_filter);
    note_widget("filter");
    ImGui::BeginChild("rows", {0.0F, height - 3.0F * ImGui::GetFrameHeightWithSpacing()});
    if (ui.row_moves != 0) {
      const auto rows = static_cast<float>(ui.row_moves);
      ImGui::SetScrollY(ImGui::GetScrollY() + rows * ImGui::GetTextLineHeightWithSpacing());
    }
    const std::vector<const Command*> found = matching_commands(ui.help_filter);
    for (const Choice<CommandGroup>& group : kCommandGroups)
      draw_group(group, found);
    if (ui.help_filter.empty()) draw_mouse();
    if (found.empty()) faint_text("No command matches.");
    ImGui::EndChild();
  }
  end_dialog(ui.areas);
}

}  // namespace mesher::app
