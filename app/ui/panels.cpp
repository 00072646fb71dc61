#include "app/ui/panels.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/document/tabs.h"
#include "app/edit/crease_edits.h"
#include "app/files/leave.h"
#include "app/input/commands.h"
#include "app/ui/controls.h"
#include "app/ui/style.h"

namespace mesher::app {
namespace {

bool has_open_dialog(const Session& session) {
  return session.shows_help || session.shows_palette || session.shows_start ||
         session.open_dialog.is_shown || session.picture.is_shown || session.saving.shows_dialog ||
         has_question(session);
}

}  // namespace

PanelActions Panels::draw(Session& session, const PanelFacts& facts) {
  const ImGuiIO& io = ImGui::GetIO();
  follow_modes(session);
  ui_.facts = facts;
  ui_.actions = {};
  ui_.areas.clear();
  ui_.noted.widgets.clear();
  ui_.noted.code_points.clear();
  ui_.chosen = nullptr;
  ui_.noted.shows_tooltips = !has_open_dialog(session);
  note_in(ui_.noted);
  set_colors(theme(session.view.settings.background));
  const glm::vec2 size{io.DisplaySize.x, io.DisplaySize.y};
  ui_.layout = layout_of(size, units(1.0F), session.shows_info, tab_count(session) > 1);
  session.panel_covers_model = session.shows_info && ui_.layout.width == Layout::Width::small;
  const float strip = legend_strip(session, ui_.layout);
  ui_.layout.model.y0 += strip;
  resize(session.view, session.document.statistics.box, facts.window,
         insets_of(ui_.layout, size, {io.DisplayFramebufferScale.x, io.DisplayFramebufferScale.y}));
  draw_legend(session, strip, ui_);
  draw_menu_bar(session, ui_);
  draw_tabs(session, ui_);
  draw_rail(session, ui_);
  draw_facts(session.document, ui_);
  draw_tool_panel(session, ui_);
  draw_detail_bar(session.document, ui_);
  draw_status_line(session, ui_);
  draw_dialogs(session);
  draw_message(session.document, ui_);
  ui_.submits = false;
  ui_.row_moves = 0;
  if (ui_.chosen != nullptr) run(session, *ui_.chosen);
  // A text field needs no more frames than its caret.
  if (ImGui::IsAnyItemActive() && !ImGui::GetIO().WantTextInput) ui_.actions.wants_frames = true;
  return std::exchange(ui_.actions, {});
}

/// A mode that was turned on, by whatever means, shows its tool.
void Panels::follow_modes(Session& session) {
  const bool has_creases = session.document.creases.is_on;
  const bool has_levels = session.document.progressive.is_on();
  if (has_creases && !had_creases_) session.tool = Tool::creases;
  if (has_levels && !had_levels_) session.tool = Tool::levels;
  if (has_creases && session.tool != Tool::creases) set_crease_mode(session.document, false);
  had_creases_ = session.document.creases.is_on;
  had_levels_ = has_levels;
}

/// Dialogs are drawn over each other in this order. Only the last one shows its tooltips.
void Panels::draw_dialogs(Session& session) {
  draw_context_menu(session, ui_);
  const bool asks = has_question(session);
  const bool has_file_dialog = session.open_dialog.is_shown || session.picture.is_shown ||
                               session.saving.shows_dialog || session.shows_start;
  const auto begin = [&](bool is_last) { ui_.noted.shows_tooltips = is_last; };
  begin(!asks && !has_file_dialog && !session.shows_palette);
  if (session.shows_help) draw_help(session.shows_help, ui_);
  begin(!asks && !has_file_dialog);
  if (session.shows_palette) draw_palette(session, ui_);
  begin(true);
  // A dialog that follows a question appears after it, so that its text field gets the keyboard.
  const bool is_asking = draw_question(session, ui_);
  if (is_asking) return;
  begin(!session.open_dialog.is_shown && !session.picture.is_shown && !session.saving.shows_dialog);
  if (session.shows_start) draw_start(session, ui_);
  begin(true);
  if (session.open_dialog.is_shown) draw_open_dialog(session, ui_);
  if (session.picture.is_shown) draw_picture_dialog(session, ui_);
  if (session.saving.shows_dialog) draw_save_dialog(session, ui_);
}

bool Panels::covers(const glm::dvec2& at) const {
  // While a slider is dragged or a color picker is open, ImGui owns the mouse everywhere.
  if (ImGui::GetIO().WantCaptureMouse && ImGui::IsAnyItemActive()) return true;
  if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) {
    return true;
  }
  return std::ranges::any_of(ui_.areas, [&](const glm::vec4& area) {
    return at.x >= area.x && at.y >= area.y && at.x < area.z && at.y < area.w;
  });
}

}  // namespace mesher::app
