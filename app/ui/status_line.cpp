#include <imgui.h>

#include <algorithm>
#include <string>

#include "app/document/shown.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/ui/style.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

// Shorter jobs show no progress, because it would flicker.
constexpr double kMomentSeconds = 0.25;

const char* mouse_hint(const Document& document) {
  return document.creases.is_on
             ? "Click: select an edge   Shift+click: its chain   Ctrl+click: add   Drag: turn"
             : "Drag: turn   Shift+drag: move   Wheel: zoom   Double click: center";
}

bool shows_job(const Ui& ui) {
  return ui.facts.job != nullptr && ui.facts.job->age_s() > kMomentSeconds;
}

/// Returns "Opening knot.obj: reading 42 %, about 3 s left".
std::string job_text(const Job& job, TimeLeft& time_left) {
  const double fraction = double{job.progress().fraction()};
  time_left.update(job.age_s(), fraction);
  return job.title() + ": " + progress_text(job.progress().stage(), fraction, time_left);
}

/// Draws the job and returns whether it is to be canceled.
bool draw_job(const Job& job, TimeLeft& time_left, bool can_cancel) {
  note_text(job.title());
  ImGui::TextUnformatted(job_text(job, time_left).c_str());
  if (!can_cancel) return false;
  ImGui::SameLine();
  const bool cancels = ImGui::SmallButton("cancel");
  note_widget("cancel");
  return cancels;
}

float status_room(const Layout& layout) {
  return layout.status.width() - units(160.0F);
}

bool fits(const std::string& text, const Layout& layout) {
  return !layout.status.is_empty() && text.find('\n') == std::string::npos &&
         ImGui::CalcTextSize(text.c_str()).x < status_room(layout);
}

}  // namespace

void draw_status_line(Session& session, Ui& ui) {
  const Document& document = session.document;
  note_text(document.notice);
  if (!begin_part("status", ui.layout.status, false)) return;
  ImGui::SetCursorPos({units(12.0F), 0.5F * (ui.layout.status.height() - ImGui::GetFontSize())});
  if (shows_job(ui)) {
    ui.actions.cancels_job |= draw_job(*ui.facts.job, ui.time_left, ui.facts.can_cancel);
  } else if (document.error.empty() && !document.notice.empty() &&
             fits(document.notice, ui.layout)) {
    ImGui::TextUnformatted(document.notice.c_str());
  } else {
    const char* hint = mouse_hint(document);
    ImGui::TextDisabled("%s", fits(hint, ui.layout) ? hint : "F1: help");
  }
  const std::string faces = count_text(shown_mesh(document).face_count(), "face");
  ImGui::SameLine(ui.layout.status.width() - ImGui::CalcTextSize(faces.c_str()).x - units(12.0F));
  ImGui::TextDisabled("%s", faces.c_str());
  end_part(ui.areas);
}

void draw_message(Document& document, Ui& ui) {
  const bool has_status = !ui.layout.status.is_empty();
  const bool has_job = shows_job(ui) && (!has_status || document.opening == 0);
  const bool has_notice = !document.notice.empty() && !fits(document.notice, ui.layout);
  if (document.error.empty() && !has_job && !has_notice) return;
  const Rect& model = ui.layout.model;
  const float width = std::min(units(460.0F), model.width() - units(16.0F));
  // A panel over the model has its buttons at the bottom.
  const bool is_at_top = !has_status && !ui.layout.panel.is_empty();
  const float y = is_at_top ? model.y0 + units(4.0F) : model.y1 - units(8.0F);
  ImGui::SetNextWindowPos({0.5F * (model.x0 + model.x1), y}, ImGuiCond_Always,
                          {0.5F, is_at_top ? 0.0F : 1.0F});
  ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, ImGui::GetIO().DisplaySize.y});
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_AlwaysAutoResize |
                                      ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoFocusOnAppearing;
  ImGui::Begin("message", nullptr, kFlags);
  if (!document.error.empty()) {
    problem_text(document.error);
    if (ImGui::Button("OK (Esc)###ok")) document.error.clear();
    note_widget("ok");
  } else if (has_job) {
    ui.actions.cancels_job |= draw_job(*ui.facts.job, ui.time_left, ui.facts.can_cancel);
  } else {
    note_text(document.notice);
    ImGui::TextWrapped("%s", document.notice.c_str());
  }
  note_area(ui.areas);
  ImGui::End();
}

}  // namespace mesher::app
