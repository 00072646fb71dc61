#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/files/folder.h"
#include "app/files/open.h"
#include "app/files/paths.h"
#include "app/input/command_functions.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"

namespace mesher::app {
namespace {

constexpr float kStartWidthPoints = 420.0F;

/// Draws a list of files. Returns the one that was clicked.
std::filesystem::path draw_files(const std::vector<std::filesystem::path>& files,
                                 const char* kind) {
  std::filesystem::path clicked;
  for (const std::filesystem::path& file : files) {
    ImGui::PushID(file.c_str());
    if (ImGui::Selectable(file.filename().c_str())) clicked = file;
    note_widget(std::string(kind) + " " + file.filename().string());
    tooltip(file.c_str());
    ImGui::PopID();
  }
  return clicked;
}

/// Height of a list in the rest of the window: whole rows.
float list_height(std::size_t count) {
  const float row = ImGui::GetTextLineHeightWithSpacing();
  // The dialog can be as high as the window.
  const float room = ImGui::GetIO().DisplaySize.y - ImGui::GetCursorPosY() -
                     ImGui::GetStyle().WindowPadding.y - ImGui::GetStyle().ItemSpacing.y;
  constexpr float kMostRows = 12.0F;
  return row *
         std::max(std::min({std::floor(room / row), static_cast<float>(count), kMostRows}), 2.0F);
}

std::vector<std::filesystem::path> samples() {
  const Folder folder = read_folder(samples_folder());
  std::vector<std::filesystem::path> files;
  for (const FolderEntry* entry : shown_entries(folder, {})) {
    if (!entry->is_folder) files.push_back(folder.path / entry->name);
  }
  return files;
}

}  // namespace

void draw_start(Session& session, Ui& ui) {
  if (begin_dialog("Welcome to mesher###start", &session.shows_start, kStartWidthPoints)) {
    if (session.samples.empty()) session.samples = samples();
    faint_text("Drop models on the window, or choose one here. Esc shows the sample behind.");
    // The message below the model would be covered.
    if (!session.document.error.empty()) problem_text(session.document.error);
    if (wide_button("Open a model... (Ctrl+O)###open", true, "Choose a file"))
      toggle_open_dialog(session);
    std::filesystem::path clicked;
    if (!session.preferences.recent.empty()) {
      heading("Recent");
      clicked = draw_files(session.preferences.recent, "recent");
    }
    heading("Samples");
    ImGui::BeginChild("samples", {0.0F, list_height(session.samples.size())});
    if (const std::filesystem::path sample = draw_files(session.samples, "sample"); !sample.empty())
      clicked = sample;
    ImGui::EndChild();
    if (!clicked.empty()) request_open(session, clicked);
  }
  end_dialog(ui.areas);
}

}  // namespace mesher::app
