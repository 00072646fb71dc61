#include <imgui.h>

#include "app/ui/panels.h"

namespace mesher::app {
namespace {

// Shorter jobs show no progress bar, because it would flicker.
constexpr double kMomentSeconds = 0.25;

void draw_progress(const Job& job, bool can_cancel, PanelActions& actions) {
  ImGui::TextUnformatted(job.title().c_str());
  ImGui::ProgressBar(job.progress().fraction(), {260.0F, 0.0F}, job.progress().stage().c_str());
  if (!can_cancel) return;
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) actions.cancels_job = true;
}

void draw_error(Document& document) {
  ImGui::PushTextWrapPos(ImGui::GetIO().DisplaySize.x * 0.6F);
  ImGui::TextColored({1.0F, 0.55F, 0.5F, 1.0F}, "%s", document.error.c_str());
  ImGui::PopTextWrapPos();
  ImGui::SameLine();
  if (ImGui::Button("OK")) document.error.clear();
}

}  // namespace

void draw_message_bar(Document& document, const PanelFacts& facts, PanelActions& actions,
                      PanelAreas& areas) {
  const bool shows_job = facts.job != nullptr && facts.job->age_s() > kMomentSeconds;
  if (!shows_job && document.error.empty() && document.notice.empty()) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y - 16.0F}, ImGuiCond_Always, {0.5F, 1.0F});
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_AlwaysAutoResize |
                                      ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoFocusOnAppearing;
  ImGui::Begin("message", nullptr, kFlags);
  if (shows_job) {
    draw_progress(*facts.job, facts.can_cancel, actions);
  } else if (!document.error.empty()) {
    draw_error(document);
  } else {
    ImGui::TextUnformatted(document.notice.c_str());
  }
  note_area(areas);
  ImGui::End();
}

}  // namespace mesher::app
