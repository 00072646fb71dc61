#include "app/commands.h"

#include <array>

#include "app/progressive_commands.h"
#include "app/progressive_edits.h"

namespace mesher::app {
namespace {

constexpr std::array kBindings{
    Binding{Command::toggle_wireframe, "w", "wireframe on and off"},
    Binding{Command::toggle_surface, "shift+w", "surface on and off (wireframe alone)"},
    Binding{Command::toggle_gouraud, "g", "Gouraud or flat shading"},
    Binding{Command::toggle_background, "b", "light or dark background"},
    Binding{Command::view_front, "1", "look from the front"},
    Binding{Command::view_right, "3", "look from the right"},
    Binding{Command::view_top, "7", "look from above"},
    Binding{Command::toggle_orthographic, "5", "orthographic or perspective"},
    Binding{Command::frame_model, "f", "show the whole model"},
    Binding{Command::simplify, "d", "remove 10 % of the triangles"},
    Binding{Command::simplify_edge, "shift+d", "collapse one edge"},
    Binding{Command::subdivide, "s", "subdivide: four triangles for each"},
    Binding{Command::coarsen, "shift+s", "back to the coarser level"},
    Binding{Command::toggle_limit, "l", "limit surface on and off"},
    Binding{Command::next_scheme, "m", "scheme: Loop, butterfly, midpoint"},
    Binding{Command::toggle_crease_rules, "r", "crease rules: Hoppe or DeRose"},
    Binding{Command::undo, "ctrl+z", "undo"},
    Binding{Command::redo, "ctrl+shift+z ctrl+y", "redo"},
    Binding{Command::toggle_creases, "c", "edit creases: clicks pick edges"},
    Binding{Command::sharpen, "+", "selected edges sharper by 1"},
    Binding{Command::smoothen, "-", "selected edges smoother by 1"},
    Binding{Command::sharpen_fully, "i", "selected edges infinitely sharp"},
    Binding{Command::clear_creases, "x delete", "selected edges smooth"},
    Binding{Command::select_creases, "ctrl+a", "select all creases"},
    Binding{Command::tag_creases, "shift+c", "tag creases by angle (as in the panel)"},
    Binding{Command::toggle_progressive, "p", "progressive mesh on and off"},
    Binding{Command::play, "space", "progressive: play or pause"},
    Binding{Command::detail_up, "pageup shift+]", "a tenth more of the detail"},
    Binding{Command::detail_down, "pagedown shift+[", "a tenth less"},
    Binding{Command::one_split_up, "] .", "one split more"},
    Binding{Command::one_split_down, "[ ,", "one split less"},
    Binding{Command::most_detail, "end", "all the detail"},
    Binding{Command::least_detail, "home", "the base"},
    Binding{Command::toggle_geomorphs, "shift+g", "splits grow (geomorphs) or pop"},
    Binding{Command::toggle_automatic, "a", "automatic level, by size on the screen"},
    Binding{Command::toggle_split_order_colors, "shift+b", "colors by birth"},
    Binding{Command::keep_level, "k", "keep this level as the model"},
    Binding{Command::toggle_info, "tab", "panels on and off"},
    Binding{Command::toggle_help, "f1 h shift+/", "this help"},
    Binding{Command::open_file, "ctrl+o", "open a file (or drop one on the window)"},
    Binding{Command::save_file, "ctrl+s", "save the model"},
    Binding{Command::screenshot, "f12", "save a picture"},
    Binding{Command::escape, "escape", "stop what runs, close what is open, then quit"},
    Binding{Command::quit, "q", "quit"},
};

void toggle(bool& value) {
  value = !value;
}

void set(bool& value) {
  value = true;
}

void toggle_gouraud(render::Settings& s) {
  using render::Shading;
  s.shading = s.shading == Shading::gouraud ? Shading::flat : Shading::gouraud;
}

void toggle_background(render::Settings& s) {
  using render::Background;
  s.background = s.background == Background::light ? Background::dark : Background::light;
}

render::View view_of(Command command) {
  if (command == Command::view_front) return render::View::front;
  return command == Command::view_right ? render::View::right : render::View::top;
}

EditRequest::Kind edit_of(Command command) {
  switch (command) {
    case Command::simplify:
      return EditRequest::Kind::remove_tenth;
    case Command::simplify_edge:
      return EditRequest::Kind::remove_edge;
    case Command::subdivide:
      return EditRequest::Kind::finer;
    case Command::coarsen:
      return EditRequest::Kind::coarser;
    case Command::undo:
      return EditRequest::Kind::undo;
    default:
      return EditRequest::Kind::redo;
  }
}

CreaseRequest crease_edit_of(const Session& session, Command command) {
  using Kind = CreaseRequest::Kind;
  switch (command) {
    case Command::tag_creases:
      return {.kind = Kind::tag_by_angle, .value = session.creases.tag_angle_deg};
    case Command::sharpen:
      return {.kind = Kind::change, .value = 1.0F};
    case Command::smoothen:
      return {.kind = Kind::change, .value = -1.0F};
    case Command::sharpen_fully:
      return {.kind = Kind::set, .value = kInfinitelySharp};
    default:
      return {.kind = Kind::set, .value = 0.0F};
  }
}

void toggle_surface(Session& session) {
  render::Settings& s = session.settings;
  if (s.shading == render::Shading::none) {
    s.shading = render::Shading::flat;
  } else {
    s.shading = render::Shading::none;
    s.wireframe = true;  // with neither there would be nothing to see
  }
}

void toggle_wireframe(render::Settings& s) {
  if (s.shading == render::Shading::none) s.shading = render::Shading::flat;
  toggle(s.wireframe);
}

Scheme next_scheme(Scheme scheme) {
  return static_cast<Scheme>((static_cast<std::size_t>(scheme) + 1) % kSchemeCount);
}

CreaseRules other_rules(CreaseRules rules) {
  return rules == CreaseRules::hoppe94 ? CreaseRules::derose98 : CreaseRules::hoppe94;
}

// The innermost thing first, as in every program.
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

void change_subdivision(Session& session, Command command) {
  SubdivideSettings& rules = session.subdivide;
  if (command == Command::toggle_limit) rules.limit = !rules.limit;
  if (command == Command::next_scheme) rules.scheme = next_scheme(rules.scheme);
  if (command == Command::toggle_crease_rules) rules.creases = other_rules(rules.creases);
  apply_subdivide_settings(session);
}

// One dialog at a time.

void toggle_open_dialog(Session& session) {
  session.saving.shows_dialog = false;
  toggle(session.shows_open_dialog);
}

void show_save_dialog(Session& session) {
  session.shows_open_dialog = false;
  open_save_dialog(session);
}

}  // namespace

std::span<const Binding> bindings() {
  return kBindings;
}

std::optional<Command> command_for(const KeyPress& key) {
  for (const Binding& binding : kBindings) {
    for (const KeyPress& bound : parse_keys(binding.keys)) {
      if (bound == key) return binding.command;
    }
  }
  return std::nullopt;
}

// As long as there are commands, a line or two each: one switch, so that the compiler finds the one
// that is missing.
void run(Session& session, Command command) {
  render::Settings& settings = session.settings;
  session.notice.clear();
  switch (command) {
    case Command::toggle_wireframe:
      return toggle_wireframe(settings);
    case Command::toggle_surface:
      return toggle_surface(session);
    case Command::toggle_gouraud:
      return toggle_gouraud(settings);
    case Command::toggle_background:
      return toggle_background(settings);
    case Command::view_front:
    case Command::view_right:
    case Command::view_top:
      return session.camera.set_view(view_of(command));
    case Command::toggle_orthographic:
      return session.camera.set_orthographic(!session.camera.is_orthographic());
    case Command::frame_model:
      return session.camera.frame(session.statistics.box, session.aspect());
    case Command::simplify:
    case Command::simplify_edge:
    case Command::subdivide:
    case Command::coarsen:
    case Command::undo:
    case Command::redo:
      return request_edit(session, {edit_of(command)});
    case Command::toggle_creases:
      return set_crease_mode(session, !session.creases.is_on);
    case Command::select_creases:
      return select_sharp_edges(session);
    case Command::tag_creases:
    case Command::sharpen:
    case Command::smoothen:
    case Command::sharpen_fully:
    case Command::clear_creases:
      return request_edit(session, {.kind = EditRequest::Kind::creases,
                                    .creases = crease_edit_of(session, command)});
    case Command::toggle_limit:
    case Command::next_scheme:
    case Command::toggle_crease_rules:
      return change_subdivision(session, command);
    case Command::toggle_progressive:
      return toggle_progressive(session);
    case Command::keep_level:
      return request_keep_level(session);
    case Command::play:
    case Command::one_split_down:
    case Command::one_split_up:
    case Command::detail_down:
    case Command::detail_up:
    case Command::least_detail:
    case Command::most_detail:
    case Command::toggle_geomorphs:
    case Command::toggle_automatic:
    case Command::toggle_split_order_colors:
      return run_progressive(session, command);
    case Command::toggle_info:
      return toggle(session.shows_info);
    case Command::toggle_help:
      return toggle(session.shows_help);
    case Command::open_file:
      return toggle_open_dialog(session);
    case Command::save_file:
      return show_save_dialog(session);
    case Command::screenshot:
      return set(session.wants_screenshot);
    case Command::escape:
      return escape(session);
    case Command::quit:
      return set(session.wants_quit);
  }
}

}  // namespace mesher::app
