#pragma once

#include "app/document/session.h"

namespace mesher::app {

// The functions that the rows of app/input/commands.cpp call, besides those of app/edit. Each takes
// the part of the session that it needs.

void toggle_wireframe(View& view);
/// Hides the surface, or shows it again. While it is hidden, the wireframe is shown.
void toggle_surface(View& view);
void toggle_gouraud(View& view);
/// Chooses the look after the one that is drawn, and says so.
void next_look(Session& session);
void toggle_background(View& view);
void next_normal_weight(View& view);
template <render::View kView>
void set_view(View& view) {
  view.camera.set_view(kView);
}
void toggle_orthographic(View& view);
void frame_model(Session& session);

void toggle_limit(Document& document);
void next_scheme(Document& document);
void toggle_crease_rules(Document& document);

void toggle_creases(Document& document);
void sharpen(Document& document);
void smoothen(Document& document);
void sharpen_fully(Document& document);
void make_smooth(Document& document);
void mark_creases_by_angle(Document& document);

// Whether a toggle is on.

bool shows_wireframe(const Session& session);
bool shows_surface(const Session& session);
bool shows_gouraud(const Session& session);
bool is_dark(const Session& session);
bool is_orthographic(const Session& session);
bool shows_limit(const Session& session);
bool edits_creases(const Session& session);
bool is_progressive(const Session& session);
template <bool ProgressiveSettings::*kMember>
bool has_progressive(const Session& session) {
  return session.document.progressive.settings().*kMember;
}
bool shows_panels(const Session& session);
bool shows_help(const Session& session);
template <Tool kTool>
bool shows_tool(const Session& session) {
  return session.shows_info && session.tool == kTool;
}

// Why commands cannot run now; null: they can.

/// The model cannot be edited in progressive mode.
const char* need_model(const Document& document);
const char* need_undo(const Document& document);
const char* need_redo(const Document& document);
/// There is an edit, and the model can be read again from its file.
const char* need_edits(const Document& document);
/// Returns why commands of progressive mode cannot run: the mode is off. Null: they can run.
const char* need_progressive(const Document& document);
/// The same, unless the model has an animation to play.
const char* need_player(const Document& document);
void play(Document& document);
void detail_up(Document& document);
void detail_down(Document& document);
void one_split_up(Document& document);
void one_split_down(Document& document);
void most_detail(Document& document);
void least_detail(Document& document);
void toggle_geomorphs(Document& document);
void toggle_automatic(Document& document);
void toggle_split_colors(Document& document);

/// Shows the panel of a tool. Creases can be selected by clicks while their tool is chosen.
void choose_tool(Session& session, Tool tool);
template <Tool kTool>
void show_tool(Session& session) {
  choose_tool(session, kTool);
}
/// Requests the command line that makes the edits of the model, for the clipboard.
void copy_command_line(Session& session);
void toggle_palette(Session& session);
void toggle_info(Session& session);
void toggle_help(Session& session);
/// Shows the tab at the right or at the left of the shown one; the last one is followed by the
/// first.
void show_next_tab(Session& session);
void show_previous_tab(Session& session);
/// Closes the shown model. Asks first if edits would be lost.
void close_model(Session& session);
/// Returns why another tab cannot be shown now. Null: it can.
const char* need_rest(const Document& document);
/// Opens a dialog and closes the other one.
void toggle_open_dialog(Session& session);
void show_save_dialog(Session& session);
void show_picture_options(Session& session);
void request_screenshot(Session& session);
/// Closes the innermost dialog, message, selection or mode.
void escape(Session& session);
/// Asks first if edits would be lost.
void quit(Session& session);

}  // namespace mesher::app
