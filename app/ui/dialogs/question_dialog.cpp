#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "app/files/leave.h"
#include "app/files/restore.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/ui/style.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

constexpr const char* kTitle = "mesher###question";
constexpr float kTextPoints = 420.0F;
// Of a long history, the last edits say best what would be lost.
constexpr std::size_t kShownEdits = 5;

std::string leaving_text(const Session& session) {
  const Document& document = session.document;
  const std::string name = document.file.filename().string();
  const char* what = session.unsaved == Leaving::quit ? "quitting" : "closing it";
  return fmt::format("{} has edits that are not saved. Save them before {}?", name, what);
}

std::string lost_text(const LostEdits& lost) {
  std::string text = lost.texts.empty()
                         ? "mesher ended before its edits were saved."
                         : fmt::format("mesher ended before {} of {} {} saved ({}).",
                                       count_text(lost.done, "edit"), lost.file.filename().string(),
                                       lost.done == 1 ? "was" : "were", lost.ended);
  if (!lost.problem.empty()) text += " They cannot be repeated: " + lost.problem + ".";
  return text;
}

void draw_text(const std::string& text) {
  note_text(text);
  ImGui::PushTextWrapPos(std::min(units(kTextPoints), ImGui::GetIO().DisplaySize.x - units(40.0F)));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
}

void draw_names(const std::vector<std::string>& names, std::size_t count) {
  const std::size_t first = count - std::min(count, kShownEdits);
  if (first > 0) ImGui::BulletText("...");
  for (std::size_t i = first; i < count; ++i) {
    ImGui::Bullet();
    draw_text(names[i]);
  }
}

/// Names of the edits that were made since the model was saved, or all that are done.
std::vector<std::string> edit_names(const History& history) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < history.done_steps(); ++i)
    names.push_back(history.steps()[i].name);
  return names;
}

/// Puts a button beside the one before it, or below it where the window ends. `is_first`: there is
/// none.
bool answer_button(const char* name, bool is_first = false) {
  const float width = ImGui::CalcTextSize(name).x + 2.0F * ImGui::GetStyle().FramePadding.x;
  const float end = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width;
  if (!is_first && end < ImGui::GetIO().DisplaySize.x - units(24.0F)) ImGui::SameLine();
  const bool is_pressed = ImGui::Button(name);
  note_widget(name);
  return is_pressed;
}

void draw_unsaved(Session& session) {
  draw_text(leaving_text(session));
  const std::vector<std::string> names = edit_names(session.document.edits.history);
  draw_names(names, names.size());
  ImGui::Spacing();
  if (answer_button("Save... (S)", true)) return answer_leave(session, LeaveAnswer::save);
  if (answer_button("Discard (Del)")) return answer_leave(session, LeaveAnswer::discard);
  if (answer_button("Cancel (Esc)")) answer_leave(session, LeaveAnswer::cancel);
}

void draw_lost(Session& session) {
  const LostEdits& lost = session.lost.front();
  draw_text(lost_text(lost));
  draw_names(lost.names, lost.done);
  ImGui::Spacing();
  ImGui::BeginDisabled(!lost.problem.empty());
  const bool restores = answer_button("Restore (R)", true);
  ImGui::EndDisabled();
  const bool discards = answer_button("Discard (Del)");
  const bool waits = answer_button("Ask later (Esc)");
  if (restores) answer_lost(session, LostAnswer::restore);
  if (discards) answer_lost(session, LostAnswer::discard);
  if (waits) answer_lost(session, LostAnswer::later);
}

}  // namespace

bool draw_question(Session& session, Ui& ui) {
  const bool asks = has_question(session);
  if (asks && !ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoTitleBar;
  if (!ImGui::BeginPopupModal(kTitle, nullptr, kFlags)) return false;
  if (session.unsaved) {
    draw_unsaved(session);
  } else if (!session.lost.empty()) {
    draw_lost(session);
  }
  if (!has_question(session)) ImGui::CloseCurrentPopup();
  note_area(ui.areas);
  ImGui::EndPopup();
  return true;
}

}  // namespace mesher::app
