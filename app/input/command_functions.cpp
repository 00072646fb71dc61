#include "app/input/command_functions.h"

#include <string>

#include "app/edit/crease_edits.h"
#include "app/edit/edits.h"
#include "app/edit/progressive_edits.h"
#include "app/edit/subdivide_edit.h"
#include "app/files/save.h"

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

void change_sharpness(Session& session, CreaseRequest::Kind kind, float value) {
  request_crease_edit(session, {.kind = kind, .value = value});
}

void toggle_setting(Session& session, bool ProgressiveSettings::*member, const std::string& what) {
  ProgressiveSettings settings = session.progressive.settings();
  toggle(settings.*member);
  session.progressive.change(settings);
  session.notice = what + (settings.*member ? " on" : " off");
}

}  // namespace

void toggle_wireframe(Session& session) {
  render::Settings& s = session.settings;
  if (s.shading == render::Shading::none) s.shading = render::Shading::flat;
  toggle(s.wireframe);
}

void toggle_surface(Session& session) {
  render::Settings& s = session.settings;
  if (s.shading == render::Shading::none) {
    s.shading = render::Shading::flat;
  } else {
    s.shading = render::Shading::none;
    s.wireframe = true;  // without both the picture would be empty
  }
}

void toggle_gouraud(Session& session) {
  using render::Shading;
  Shading& shading = session.settings.shading;
  shading = shading == Shading::gouraud ? Shading::flat : Shading::gouraud;
}

void toggle_background(Session& session) {
  session.settings.background = next(session.settings.background);
}

void toggle_orthographic(Session& session) {
  session.camera.set_orthographic(!session.camera.is_orthographic());
}

void frame_model(Session& session) {
  session.camera.frame(session.statistics.box, session.aspect());
}

void toggle_limit(Session& session) {
  toggle(session.subdivide.limit);
  apply_subdivide_settings(session);
}

void next_scheme(Session& session) {
  session.subdivide.scheme = next(session.subdivide.scheme);
  apply_subdivide_settings(session);
}

void toggle_crease_rules(Session& session) {
  session.subdivide.creases = next(session.subdivide.creases);
  apply_subdivide_settings(session);
}

void toggle_creases(Session& session) {
  set_crease_mode(session, !session.creases.is_on);
}

void sharpen(Session& session) {
  change_sharpness(session, CreaseRequest::Kind::change, 1.0F);
}

void smoothen(Session& session) {
  change_sharpness(session, CreaseRequest::Kind::change, -1.0F);
}

void sharpen_fully(Session& session) {
  change_sharpness(session, CreaseRequest::Kind::set, kInfinitelySharp);
}

void make_smooth(Session& session) {
  change_sharpness(session, CreaseRequest::Kind::set, 0.0F);
}

void mark_creases_by_angle(Session& session) {
  change_sharpness(session, CreaseRequest::Kind::tag_by_angle, session.creases.tag_angle_deg);
}

const char* need_progressive(const Session& session) {
  return session.progressive.is_on() ? nullptr
                                     : "press P first: this key works in progressive mode";
}

void play(Session& session) {
  session.progressive.play(!session.progressive.is_playing());
}

void detail_up(Session& session) {
  session.progressive.move_to(session.progressive.position() + kDetailStep);
}

void detail_down(Session& session) {
  session.progressive.move_to(session.progressive.position() - kDetailStep);
}

void one_split_up(Session& session) {
  session.progressive.move_by(1);
}

void one_split_down(Session& session) {
  session.progressive.move_by(-1);
}

void most_detail(Session& session) {
  session.progressive.move_to(1.0);
}

void least_detail(Session& session) {
  session.progressive.move_to(0.0);
}

void toggle_geomorphs(Session& session) {
  toggle_setting(session, &ProgressiveSettings::geomorphs, "geomorphs");
}

void toggle_automatic(Session& session) {
  toggle_setting(session, &ProgressiveSettings::is_automatic, "automatic level");
}

void toggle_split_colors(Session& session) {
  toggle_setting(session, &ProgressiveSettings::colors_by_split_order, "colors by split order");
}

void toggle_info(Session& session) {
  toggle(session.shows_info);
}

void toggle_help(Session& session) {
  toggle(session.shows_help);
}

void toggle_open_dialog(Session& session) {
  session.saving.shows_dialog = false;
  toggle(session.shows_open_dialog);
}

void show_save_dialog(Session& session) {
  session.shows_open_dialog = false;
  open_save_dialog(session);
}

void request_screenshot(Session& session) {
  session.wants_screenshot = true;
}

void escape(Session& session) {
  if (session.shows_open_dialog) {
    session.shows_open_dialog = false;
  } else if (session.saving.shows_dialog) {
    session.saving.shows_dialog = false;
  } else if (session.shows_help) {
    session.shows_help = false;
  } else if (!session.error.empty()) {
    session.error.clear();
  } else if (!session.creases.selected.empty()) {
    session.creases.selected.clear();
  } else if (session.creases.is_on) {
    set_crease_mode(session, false);
  } else if (session.progressive.is_on() && !session.progressive.is_arriving()) {
    leave_progressive(session);
  } else {
    session.wants_quit = true;
  }
}

void quit(Session& session) {
  session.wants_quit = true;
}

}  // namespace mesher::app
