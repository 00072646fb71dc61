#pragma once

#include "app/document/session.h"

namespace mesher::app {

// The functions that the rows of app/input/commands.cpp call, besides those of app/edit and
// app/files.

void toggle_wireframe(Session& session);
/// Hides the surface, or shows it again. While it is hidden, the wireframe is shown.
void toggle_surface(Session& session);
void toggle_gouraud(Session& session);
void toggle_background(Session& session);
template <render::View kView>
void set_view(Session& session) {
  session.camera.set_view(kView);
}
void toggle_orthographic(Session& session);
void frame_model(Session& session);

void toggle_limit(Session& session);
void next_scheme(Session& session);
void toggle_crease_rules(Session& session);

void toggle_creases(Session& session);
void sharpen(Session& session);
void smoothen(Session& session);
void sharpen_fully(Session& session);
void make_smooth(Session& session);
void mark_creases_by_angle(Session& session);

/// Returns why commands of progressive mode cannot run: the mode is off. Null: they can run.
const char* need_progressive(const Session& session);
void play(Session& session);
void detail_up(Session& session);
void detail_down(Session& session);
void one_split_up(Session& session);
void one_split_down(Session& session);
void most_detail(Session& session);
void least_detail(Session& session);
void toggle_geomorphs(Session& session);
void toggle_automatic(Session& session);
void toggle_split_colors(Session& session);

void toggle_info(Session& session);
void toggle_help(Session& session);
/// Opens a dialog and closes the other one.
void toggle_open_dialog(Session& session);
void show_save_dialog(Session& session);
void request_screenshot(Session& session);
/// Closes the innermost dialog, message, selection or mode; quits if none is open.
void escape(Session& session);
void quit(Session& session);

}  // namespace mesher::app
