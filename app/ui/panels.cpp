#include "app/ui/panels.h"

#include <imgui.h>

namespace mesher::app {

PanelActions Panels::draw(Session& session, const PanelFacts& facts) {
  PanelActions actions;
  areas_.clear();
  if (session.shows_info) {
    draw_info_panel(session.document, session.view.settings, facts, session.shows_info, areas_);
    draw_right_column(session.document, session.view, facts);
  }
  if (session.shows_help) draw_help_panel(session.shows_help, areas_);
  // A dialog that follows a question appears after it, so that its text field gets the keyboard.
  const bool is_asking = draw_question(session, areas_);
  if (session.shows_open_dialog && !is_asking) {
    draw_open_dialog(session.shows_open_dialog, typed_path_, submits_path_, actions, areas_);
  }
  if (session.saving.shows_dialog && !is_asking)
    draw_save_dialog(session.saving, session.document, submits_save_, areas_);
  submits_path_ = submits_save_ = false;
  draw_message_bar(session.document, facts, actions, areas_);
  if (ImGui::IsAnyItemActive()) actions.wants_frames = true;
  return actions;
}

void Panels::draw_right_column(Document& document, const View& view, const PanelFacts& facts) {
  float top = kPanelMargin;
  if (document.progressive.is_on()) {  // the model cannot be edited
    draw_progressive_panel(document, view, facts, top, areas_);
    return;
  }
  if (document.creases.is_on) {
    top = kPanelMargin + draw_crease_panel(document, facts, top, tag_count_, areas_);
  }
  top = kPanelMargin + draw_subdivide_panel(document, top, areas_);
  draw_simplify_panel(document, facts, top, slider_faces_, areas_);
}

bool Panels::covers(const glm::dvec2& at) const {
  // While a slider is dragged or a color picker is open, ImGui owns the mouse everywhere.
  if (ImGui::GetIO().WantCaptureMouse && ImGui::IsAnyItemActive()) return true;
  if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) {
    return true;
  }
  for (const glm::vec4& area : areas_) {
    if (at.x >= area.x && at.y >= area.y && at.x < area.z && at.y < area.w) return true;
  }
  return false;
}

void note_area(PanelAreas& areas) {
  const ImVec2 at = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  // ImGui uses the window's units, and mouse events use pixels. They differ on scaled displays.
  const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
  areas.emplace_back(at.x * scale.x, at.y * scale.y, (at.x + size.x) * scale.x,
                     (at.y + size.y) * scale.y);
}

}  // namespace mesher::app
