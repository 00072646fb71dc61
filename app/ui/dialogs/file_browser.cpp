#include "app/document/file_browser.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>

#include "app/files/browse.h"
#include "app/files/paths.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/ui/style.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

// Lengths in points.
constexpr float kPlacesPoints = 150.0F;
constexpr float kPlacesNeedPoints = 560.0F;
constexpr float kListMostPoints = 320.0F;
constexpr float kListLeastPoints = 60.0F;
// Of the browser without its list, and of the dialog's frame.
constexpr float kFramePoints = 170.0F;

/// Reads the folder again if it is another one or has changed.
void update_list(ShownFolder& list, const fs::path& folder) {
  std::error_code ignored;
  const fs::file_time_type changed = fs::last_write_time(folder, ignored);
  if (list.folder.path == folder && list.read_at == changed) return;
  list.folder = read_folder(folder);
  list.read_at = changed;
  list.code_points.clear();
  for (const FolderEntry& entry : list.folder.entries)
    list.code_points.add_text(entry.name);
}

/// The folders above the shown one, as buttons. The first ones are left out if there is no room.
void draw_path(FileBrowser& browser, const fs::path& folder) {
  std::vector<fs::path> parts;
  for (fs::path part = folder; parts.empty() || part != parts.back(); part = part.parent_path())
    parts.push_back(part);
  const auto name_of = [](const fs::path& part) {
    return part.has_filename() ? part.filename().string() : part.string();
  };
  const float gap = ImGui::GetStyle().ItemSpacing.x + 2 * ImGui::GetStyle().FramePadding.x;
  float room = ImGui::GetContentRegionAvail().x - units(24.0F);
  std::size_t count = 0;
  for (; count < parts.size(); ++count) {
    room -= ImGui::CalcTextSize(name_of(parts[count]).c_str()).x + gap;
    if (room < 0.0F && count > 0) break;
  }
  if (count < parts.size()) {
    ImGui::TextDisabled("...");
    ImGui::SameLine();
  }
  for (std::size_t i = count; i-- > 0;) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::SmallButton(name_of(parts[i]).c_str())) go_to(browser, parts[i]);
    note_widget("folder " + name_of(parts[i]));
    ImGui::PopID();
    if (i > 0) ImGui::SameLine();
  }
}

void draw_places(FileBrowser& browser, const Session& session, const std::vector<Place>& places,
                 Ui& ui) {
  int number = 0;
  for (const Place& place : places) {
    ImGui::PushID(number++);
    if (ImGui::Selectable(place.name.c_str())) go_to(browser, place.folder);
    note_widget("place " + place.name);
    tooltip(place.folder.c_str());
    ImGui::PopID();
  }
  if (session.preferences.recent.empty() || !browser.searches) return;
  heading("Recent");
  for (const fs::path& file : session.preferences.recent) {
    ImGui::PushID(number++);
    if (ImGui::Selectable(file.filename().c_str(), false, ImGuiSelectableFlags_AllowDoubleClick)) {
      browser.row.reset();
      set_text(browser, file.string());
      if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) ui.submits = true;
    }
    note_widget("recent " + file.filename().string());
    tooltip(file.c_str());
    ImGui::PopID();
  }
}

void follow_sorting(FolderFilter& filter) {
  const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
  if (specs == nullptr || specs->SpecsCount == 0) return;
  filter.order = static_cast<FolderOrder>(specs->Specs[0].ColumnUserID);
  filter.is_descending = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
}

void begin_columns(bool has_dates) {
  constexpr ImGuiTableColumnFlags kFixed = ImGuiTableColumnFlags_WidthFixed;
  const auto id = [](FolderOrder order) { return static_cast<ImGuiID>(order); };
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("Name",
                          ImGuiTableColumnFlags_WidthStretch | ImGuiTableColumnFlags_DefaultSort,
                          0.0F, id(FolderOrder::name));
  ImGui::TableSetupColumn("Size", kFixed, units(76.0F), id(FolderOrder::size));
  if (has_dates)
    ImGui::TableSetupColumn("Modified", kFixed, units(132.0F), id(FolderOrder::modified));
  ImGui::TableHeadersRow();
}

/// Draws a row. Returns whether it was clicked twice.
bool draw_entry(FileBrowser& browser, const FolderEntry& entry, int row, bool has_dates) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const std::string name = entry.is_folder ? entry.name + "/" : entry.name;
  const bool is_chosen = browser.row == row;
  bool is_twice = false;
  const float end = content_end();
  ImGui::PushID(row);
  if (ImGui::Selectable(
          "##entry", is_chosen,
          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick)) {
    if (!entry.is_folder) choose(browser, entry);
    browser.row = row;
    is_twice = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
  }
  note_widget("file " + name);
  if (!ellipsis_text(name, end)) tooltip(name.c_str());
  ImGui::PopID();
  ImGui::TableNextColumn();
  if (!entry.is_folder) ImGui::TextDisabled("%s", bytes_text(entry.bytes).c_str());
  if (!has_dates) return is_twice;
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", time_text(entry.modified).c_str());
  return is_twice;
}

void draw_list(FileBrowser& browser, const std::vector<const FolderEntry*>& shown, float height,
               Ui& ui) {
  const bool has_dates = ImGui::GetContentRegionAvail().x > units(360.0F);
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_ScrollY | ImGuiTableFlags_Sortable | ImGuiTableFlags_BordersOuter;
  if (!ImGui::BeginTable("files", has_dates ? 3 : 2, kFlags, {0.0F, height})) return;
  begin_columns(has_dates);
  follow_sorting(browser.filter);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(shown.size()));
  const bool moves = ui.row_moves != 0;
  if (moves && browser.row) clipper.ForceDisplayRangeByIndices(*browser.row, *browser.row + 1);
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      if (draw_entry(browser, *shown[static_cast<std::size_t>(i)], i, has_dates)) ui.submits = true;
      if (moves && browser.row == i) ImGui::SetScrollHereY();
    }
  }
  ImGui::EndTable();
}

struct TextContext {
  FileBrowser& browser;
  const std::vector<const FolderEntry*>& shown;
};

/// Completes the text while ImGui owns it.
int edit_text(ImGuiInputTextCallbackData* data) {
  const auto& [browser, shown] = *static_cast<TextContext*>(data->UserData);
  if (!browser.wants_completion) return 0;
  browser.wants_completion = false;
  const std::string whole =
      completed_text(std::string(data->Buf, data->Buf + data->BufTextLen), shown);
  data->DeleteChars(0, data->BufTextLen);
  data->InsertChars(0, whole.c_str());
  return 0;
}

void draw_text_field(FileBrowser& browser, const std::vector<const FolderEntry*>& shown,
                     std::uint32_t& text_shown) {
  if (ImGui::IsWindowAppearing() || text_shown != browser.texts_set) ImGui::SetKeyboardFocusHere();
  text_shown = browser.texts_set;
  ImGui::SetNextItemWidth(-FLT_MIN);
  TextContext context{browser, shown};
  // While a field is edited, ImGui keeps the text of its id. Another id shows the new text.
  // `submits` alone reports Enter: ImGui sees the key as well, and must not submit twice.
  const std::string id = "##typed" + std::to_string(browser.texts_set);
  const char* hint = browser.searches ? "part of a name, a name or a path" : "a name or a path";
  if (ImGui::InputTextWithHint(id.c_str(), hint, &browser.typed,
                               ImGuiInputTextFlags_AutoSelectAll |
                                   ImGuiInputTextFlags_CallbackAlways |
                                   ImGuiInputTextFlags_CallbackCompletion,
                               edit_text, &context))
    follow_text(browser);
  note_widget("name");
  browser.wants_completion = false;
}

void draw_switches(FolderFilter& filter) {
  ImGui::Checkbox("hidden files", &filter.shows_hidden);
  note_widget("hidden files");
  ImGui::SameLine();
  ImGui::Checkbox("all files", &filter.shows_all_files);
  note_widget("all files");
}

}  // namespace

std::vector<const FolderEntry*> draw_browser(FileBrowser& browser, Session& session,
                                             ShownFolder& list, float rest_points, Ui& ui) {
  if (ImGui::IsWindowAppearing()) list.places = places();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float height = std::clamp(size.y - units(kFramePoints + rest_points),
                                  units(kListLeastPoints), units(kListMostPoints));
  draw_path(browser, shown_folder(browser));
  // Where only a name fits beside the rest of the dialog, the name is what counts.
  const bool has_list = size.y >= units(kFramePoints + rest_points);
  if (has_list && ImGui::GetContentRegionAvail().x > units(kPlacesNeedPoints)) {
    ImGui::BeginChild("places", {units(kPlacesPoints), height});
    draw_places(browser, session, list.places, ui);
    ImGui::EndChild();
    ImGui::SameLine();
  }
  update_list(list, shown_folder(browser));
  // All at once, so that the font is not built again whenever the list is scrolled.
  note_code_points(list.code_points);
  note_text(browser.typed);
  const std::vector<const FolderEntry*> shown = shown_entries(list.folder, browser.filter);
  if (ui.row_moves != 0) move_row(browser, ui.row_moves, shown.size());
  if (has_list) draw_list(browser, shown, height, ui);
  if (!list.folder.problem.empty()) problem_text(list.folder.problem);
  if (!list.folder.is_whole)
    faint_text("Only the first " + count_text(std::int64_t(Folder::kMostEntries)) +
               " entries of this folder are listed.");
  draw_text_field(browser, shown, list.text_shown);
  if (has_list) draw_switches(browser.filter);
  session.preferences.shows_hidden_files = browser.filter.shows_hidden;
  if (!browser.problem.empty()) problem_text(browser.problem);
  return shown;
}

}  // namespace mesher::app
