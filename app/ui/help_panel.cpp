#include <imgui.h>

#include "app/commands.h"
#include "app/ui/panels.h"

namespace mesher::app {
namespace {

struct MouseHelp {
  const char* gesture;
  const char* what;
};

constexpr MouseHelp kMouse[] = {
    {"drag", "turn"},
    {"Shift+drag, right drag", "move"},
    {"wheel", "nearer or farther, at the cursor"},
    {"double click", "turn around the point under the cursor"},
    {"drop a file", "open it"},
    {"editing creases: click", "pick the edge; Ctrl: one more or less"},
    {"Shift+click, double click", "pick the chain of edges"},
};

void row(const std::string& keys, const char* what) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(keys.c_str());
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(what);
}

std::string keys_text(std::string_view keys) {
  std::string text;
  for (const KeyPress& key : parse_keys(keys)) {
    if (!text.empty()) text += ", ";
    text += key == KeyPress{"/", true, false} ? "?" : to_text(key);
  }
  return text;
}

}  // namespace

void draw_help_panel(Session& session, PanelAreas& areas) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  bool is_open = true;
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove;
  if (ImGui::Begin("Keys and mouse", &is_open, kFlags)) {
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
      for (const Binding& binding : bindings()) {
        row(keys_text(binding.keys), std::string(binding.what).c_str());
      }
      for (const MouseHelp& help : kMouse)
        row(help.gesture, help.what);
      ImGui::EndTable();
    }
    ImGui::Separator();
    ImGui::TextDisabled(
        "red: boundary   yellow: crease   bright blue: selected   blue: back of a face");
  }
  note_area(areas);
  ImGui::End();
  session.shows_help = is_open;
}

}  // namespace mesher::app
