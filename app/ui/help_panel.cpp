#include <imgui.h>

#include <span>
#include <vector>

#include "app/input/commands.h"
#include "app/ui/panels.h"

namespace mesher::app {
namespace {

struct MouseHelp {
  const char* gesture;
  const char* what;
};

constexpr MouseHelp kMouse[] = {
    {"drag", "rotate"},
    {"Shift+drag, right drag", "pan"},
    {"wheel", "zoom at the cursor"},
    {"double click", "rotate around the point under the cursor"},
    {"drop a file", "open it"},
    {"click (editing creases)", "select the edge; Ctrl: add or remove it"},
    {"Shift+click, double click", "select the chain of edges"},
};

std::string keys_text(std::string_view keys) {
  std::string text;
  for (const KeyPress& key : parse_keys(keys)) {
    if (!text.empty()) text += ", ";
    text += key == KeyPress{"/", true, false} ? "?" : to_text(key);
  }
  return text;
}

struct Row {
  std::string keys;
  std::string what;
};

/// Commands by group, under the group's name; the mouse last. An empty key column marks a name.
std::vector<Row> rows() {
  std::vector<Row> all;
  for (const Choice<CommandGroup>& group : kCommandGroups) {
    all.push_back({"", group.text.label});
    for (const Command& command : commands()) {
      if (command.group == group.value) all.push_back({keys_text(command.keys), command.help});
    }
  }
  all.push_back({"", "Mouse"});
  for (const MouseHelp& help : kMouse)
    all.push_back({help.gesture, help.what});
  return all;
}

void draw_rows(const char* name, std::span<const Row> rows) {
  if (!ImGui::BeginTable(name, 2, ImGuiTableFlags_SizingFixedFit)) return;
  for (const Row& row : rows) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (row.keys.empty()) {
      ImGui::TextDisabled("%s", row.what.c_str());
      continue;
    }
    ImGui::TextUnformatted(row.keys.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.what.c_str());
  }
  ImGui::EndTable();
}

/// Draws the rows in two columns if the window is wide enough.
void draw_all_rows(float window_width) {
  constexpr float kFitsTwo = 1100.0F;
  constexpr float kColumn = 460.0F;
  const std::vector<Row> all = rows();
  const std::span<const Row> span(all);
  if (window_width < kFitsTwo) return draw_rows("keys", span);
  const std::size_t half = (all.size() + 1) / 2;
  ImGui::BeginGroup();
  draw_rows("keys", span.first(half));
  ImGui::EndGroup();
  ImGui::SameLine(kColumn);
  ImGui::BeginGroup();
  draw_rows("more", span.subspan(half));
  ImGui::EndGroup();
}

}  // namespace

void draw_help_panel(bool& is_open, PanelAreas& areas) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove;
  if (ImGui::Begin("Keys and mouse", &is_open, kFlags)) {
    draw_all_rows(size.x);
    ImGui::Separator();
    ImGui::TextDisabled(
        "red: boundary   yellow: crease   bright blue: selected   blue: back of a face");
  }
  note_area(areas);
  ImGui::End();
}

}  // namespace mesher::app
