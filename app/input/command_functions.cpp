#include "app/input/command_functions.h"

#include <string>

#include "app/document/tabs.h"
#include "app/edit/crease_edits.h"
#include "app/edit/edits.h"
#include "app/edit/model_edit.h"
#include "app/edit/progressive_edits.h"
#include "app/edit/subdivide_edit.h"
#include "app/files/command_line.h"
#include "app/files/leave.h"
#include "app/files/open.h"
#include "app/files/picture_requests.h"
#include "app/files/save.h"
#include "engine/core/text.h"
#include "engine/render/look.h"

namespace mesher::app {
namespace {

// Share of the slider's length.
constexpr double kDetailStep = 0.1;

void toggle(bool& value) {
  value = !value;
}

template <class Enum>
Enum next(Enum value) {
  return static_cast<Enum>((static_cast<std::size_t>(value) + 1) % choices(value).size());
}

/// Edits that are still to be made may give something to undo or redo.
bool may_change(const Edits& edits) {
  return !edits.waiting.empty() || edits.is_changing;
}

void change_sharpness(Document& document, CreaseRequest::Kind kind, float value) {
  request_crease_edit(document, {.kind = kind, .value = value});
}

void close_file_dialogs(Session& session) {
  session.open_dialog.is_shown = false;
  session.saving.shows_dialog = false;
  session.picture.is_shown = false;
  session.shows_start = false;
}

void toggle_setting(Document& document, bool ProgressiveSettings::*member,
                    const std::string& what) {
  ProgressiveSettings settings = document.progressive.settings();
  toggle(settings.*member);
  document.progressive.change(settings);
  document.notice = what + (settings.*member ? " on" : " off");
}

}  // namespace

void toggle_wireframe(View& view) {
  render::Settings& s = view.settings;
  if (s.shading == render::Shading::none) s.shading = render::Shading::flat;
  toggle(s.wireframe);
}

void toggle_surface(View& view) {
  render::Settings& s = view.settings;
  if (s.shading == render::Shading::none) {
    s.shading = render::Shading::flat;
  } else {
    s.shading = render::Shading::none;
    s.wireframe = true;  // without both the picture would be empty
  }
}

void toggle_gouraud(View& view) {
  using render::Shading;
  Shading& shading = view.settings.shading;
  shading = shading == Shading::gouraud ? Shading::flat : Shading::gouraud;
}

void next_look(Session& session) {
  using render::Look;
  const Model& model = session.document.model;
  render::Settings& settings = session.view.settings;
  if (settings.shading == render::Shading::none) settings.shading = render::Shading::flat;
  settings.look = next(render::drawn_look(settings, &model.attributes, model.materials.get()));
  if (settings.look == Look::automatic) settings.look = next(Look::automatic);
  session.document.notice = "look: " + std::string(describe(settings.look));
}

void toggle_background(View& view) {
  view.settings.background = next(view.settings.background);
}

void next_normal_weight(View& view) {
  view.settings.normal_weight = next(view.settings.normal_weight);
}

void toggle_orthographic(View& view) {
  view.camera.set_orthographic(!view.camera.is_orthographic());
}

bool shows_wireframe(const Session& session) {
  return session.view.settings.wireframe;
}

bool shows_surface(const Session& session) {
  return session.view.settings.shading != render::Shading::none;
}

bool shows_gouraud(const Session& session) {
  return session.view.settings.shading == render::Shading::gouraud;
}

bool is_dark(const Session& session) {
  return session.view.settings.background == render::Background::dark;
}

bool is_orthographic(const Session& session) {
  return session.view.camera.is_orthographic();
}

bool shows_limit(const Session& session) {
  return session.document.subdivide.limit;
}

bool edits_creases(const Session& session) {
  return session.document.creases.is_on;
}

bool is_progressive(const Session& session) {
  return session.document.progressive.is_on();
}

bool shows_panels(const Session& session) {
  return session.shows_info;
}

bool shows_help(const Session& session) {
  return session.shows_help;
}

void frame_model(Session& session) {
  session.view.camera.frame(session.document.statistics.box, session.view.aspect());
}

void toggle_limit(Document& document) {
  toggle(document.subdivide.limit);
  apply_subdivide_settings(document);
}

void next_scheme(Document& document) {
  document.subdivide.scheme = next(document.subdivide.scheme);
  apply_subdivide_settings(document);
}

void toggle_crease_rules(Document& document) {
  document.subdivide.creases = next(document.subdivide.creases);
  apply_subdivide_settings(document);
}

void toggle_creases(Document& document) {
  set_crease_mode(document, !document.creases.is_on);
}

void sharpen(Document& document) {
  change_sharpness(document, CreaseRequest::Kind::change, 1.0F);
}

void smoothen(Document& document) {
  change_sharpness(document, CreaseRequest::Kind::change, -1.0F);
}

void sharpen_fully(Document& document) {
  change_sharpness(document, CreaseRequest::Kind::set, kInfinitelySharp);
}

void make_smooth(Document& document) {
  change_sharpness(document, CreaseRequest::Kind::set, 0.0F);
}

void mark_creases_by_angle(Document& document) {
  change_sharpness(document, CreaseRequest::Kind::tag_by_angle, document.creases.tag_angle_deg);
}

const char* need_model(const Document& document) {
  return progressive_refusal(document);
}

const char* need_undo(const Document& document) {
  if (const char* reason = need_model(document)) return reason;
  const bool can = document.edits.history.undo_depth() > 0 || may_change(document.edits);
  return can ? nullptr : "nothing to undo";
}

const char* need_redo(const Document& document) {
  if (const char* reason = need_model(document)) return reason;
  const bool can = document.edits.history.redo_depth() > 0 || may_change(document.edits);
  return can ? nullptr : "nothing to redo";
}

const char* need_edits(const Document& document) {
  if (document.edits.history.done_steps() == 0) return "there are no edits to copy";
  return document.source.stamp ? nullptr : "the model cannot be read again from its file";
}

const char* need_player(const Document& document) {
  return has_animations(document) ? nullptr : need_progressive(document);
}

const char* need_progressive(const Document& document) {
  return document.progressive.is_on() ? nullptr
                                      : "press P first: this key works in progressive mode";
}

void play(Document& document) {
  if (!document.progressive.is_on()) return play_animation(document);
  document.progressive.play(!document.progressive.is_playing());
}

void detail_up(Document& document) {
  document.progressive.move_to(document.progressive.position() + kDetailStep);
}

void detail_down(Document& document) {
  document.progressive.move_to(document.progressive.position() - kDetailStep);
}

void one_split_up(Document& document) {
  document.progressive.move_by(1);
}

void one_split_down(Document& document) {
  document.progressive.move_by(-1);
}

void most_detail(Document& document) {
  document.progressive.move_to(1.0);
}

void least_detail(Document& document) {
  document.progressive.move_to(0.0);
}

void toggle_geomorphs(Document& document) {
  toggle_setting(document, &ProgressiveSettings::geomorphs, "geomorphs");
}

void toggle_automatic(Document& document) {
  toggle_setting(document, &ProgressiveSettings::is_automatic, "automatic level");
}

void toggle_split_colors(Document& document) {
  toggle_setting(document, &ProgressiveSettings::colors_by_split_order, "colors by split order");
}

void choose_tool(Session& session, Tool tool) {
  session.tool = tool;
  session.shows_info = true;
  const bool edits_creases = tool == Tool::creases && !session.document.progressive.is_on();
  if (session.document.creases.is_on != edits_creases)
    set_crease_mode(session.document, edits_creases);
}

void copy_command_line(Session& session) {
  session.copied = command_line(session.document);
  const std::size_t edits = session.document.edits.history.done_steps();
  session.document.notice =
      "copied a command line that makes " + count_text(std::int64_t(edits), "edit");
}

void toggle_palette(Session& session) {
  toggle(session.shows_palette);
}

void toggle_info(Session& session) {
  toggle(session.shows_info);
}

void toggle_help(Session& session) {
  toggle(session.shows_help);
}

void show_next_tab(Session& session) {
  if (tab_count(session) == 1) session.document.notice = "no other model is open";
  show_tab(session, (shown_tab(session) + 1) % tab_count(session));
}

void show_previous_tab(Session& session) {
  if (tab_count(session) == 1) session.document.notice = "no other model is open";
  show_tab(session, (shown_tab(session) + tab_count(session) - 1) % tab_count(session));
}

void close_model(Session& session) {
  request_leave(session, Leaving::close);
}

const char* need_rest(const Document& document) {
  return tab_refusal(document);
}

void toggle_open_dialog(Session& session) {
  const bool was_shown = session.open_dialog.is_shown;
  close_file_dialogs(session);
  if (!was_shown) show_open_dialog(session);
}

void show_save_dialog(Session& session) {
  close_file_dialogs(session);
  open_save_dialog(session.saving, session.document, session.preferences);
}

void show_picture_options(Session& session) {
  close_file_dialogs(session);
  show_picture_dialog(session);
}

void request_screenshot(Session& session) {
  session.wants_screenshot = true;
}

void escape(Session& session) {
  if (session.open_dialog.is_shown) {
    session.open_dialog.is_shown = false;
  } else if (session.saving.shows_dialog) {
    session.saving.shows_dialog = false;
  } else if (session.picture.is_shown) {
    session.picture.is_shown = false;
  } else if (session.shows_palette) {
    session.shows_palette = false;
  } else if (session.shows_start && session.document.error.empty()) {
    session.shows_start = false;
  } else if (session.shows_help) {
    session.shows_help = false;
  } else if (!session.document.error.empty()) {
    session.document.error.clear();
  } else if (!session.document.creases.selected.empty()) {
    session.document.creases.selected.clear();
  } else if (session.document.creases.is_on) {
    set_crease_mode(session.document, false);
  } else if (session.document.progressive.is_on() && !session.document.progressive.is_arriving()) {
    leave_progressive(session.document);
  } else if (session.panel_covers_model) {
    session.shows_info = false;
  }
}

void quit(Session& session) {
  request_leave(session, Leaving::quit);
}

}  // namespace mesher::app
