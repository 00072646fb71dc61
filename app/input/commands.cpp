#include "app/input/commands.h"

#include <algorithm>

#include "app/edit/crease_edits.h"
#include "app/edit/edits.h"
#include "app/edit/progressive_edits.h"
#include "app/edit/subdivide_edit.h"
#include "app/files/leave.h"
#include "app/files/restore.h"
#include "app/input/command_functions.h"
#include "engine/core/assert.h"

namespace mesher::app {
namespace {

// Not a letter, because a person may press the key of a command before seeing the question.
constexpr const char* kDiscardKey = "delete";

using Group = CommandGroup;

constexpr Command kCommands[] = {
    {"toggle_wireframe", "w", Group::look, "show or hide the wireframe", toggle_wireframe},
    {"toggle_surface", "shift+w", Group::look, "show or hide the surface", toggle_surface},
    {"toggle_gouraud", "g", Group::look, "Gouraud or flat shading", toggle_gouraud},
    {"toggle_background", "b", Group::look, "light or dark background", toggle_background},
    {"view_front", "1", Group::look, "view from the front", set_view<render::View::front>},
    {"view_right", "3", Group::look, "view from the right", set_view<render::View::right>},
    {"view_top", "7", Group::look, "view from above", set_view<render::View::top>},
    {"toggle_orthographic", "5", Group::look, "orthographic or perspective", toggle_orthographic},
    {"frame_model", "f", Group::look, "show the whole model", frame_model},

    {"simplify", "d", Group::simplify, "remove 10 % of the faces", request_remove_tenth},
    {"simplify_edge", "shift+d", Group::simplify, "collapse one edge", request_collapse_edge},
    {"undo", "ctrl+z", Group::simplify, "undo", request_undo},
    {"redo", "ctrl+shift+z ctrl+y", Group::simplify, "redo", request_redo},

    {"subdivide", "s", Group::subdivide, "subdivide: each face becomes four", request_subdivide},
    {"coarsen", "shift+s", Group::subdivide, "previous level", request_previous_level},
    {"toggle_limit", "l", Group::subdivide, "limit surface on or off", toggle_limit},
    {"next_scheme", "m", Group::subdivide, "next scheme: Loop, butterfly, midpoint", next_scheme},
    {"toggle_crease_rules", "r", Group::subdivide, "crease rules: Hoppe or DeRose",
     toggle_crease_rules},

    {"toggle_creases", "c", Group::creases, "edit creases: clicks select edges", toggle_creases},
    {"sharpen", "+", Group::creases, "make selected edges sharper by 1", sharpen},
    {"smoothen", "-", Group::creases, "make selected edges smoother by 1", smoothen},
    {"sharpen_fully", "i", Group::creases, "make selected edges infinitely sharp", sharpen_fully},
    {"clear_creases", "x delete", Group::creases, "make selected edges smooth", make_smooth},
    {"select_creases", "ctrl+a", Group::creases, "select all creases", select_sharp_edges},
    {"tag_creases", "shift+c", Group::creases, "mark creases by the angle set in the panel",
     mark_creases_by_angle},

    {"toggle_progressive", "p", Group::progressive, "progressive mode on or off",
     toggle_progressive},
    {"play", "space", Group::progressive, "play or pause", play, need_progressive},
    {"detail_up", "pageup shift+]", Group::progressive, "more detail, by a tenth", detail_up,
     need_progressive},
    {"detail_down", "pagedown shift+[", Group::progressive, "less detail, by a tenth", detail_down,
     need_progressive},
    {"one_split_up", "] .", Group::progressive, "one more vertex split", one_split_up,
     need_progressive},
    {"one_split_down", "[ ,", Group::progressive, "one vertex split fewer", one_split_down,
     need_progressive},
    {"most_detail", "end", Group::progressive, "full detail", most_detail, need_progressive},
    {"least_detail", "home", Group::progressive, "the coarsest level", least_detail,
     need_progressive},
    {"toggle_geomorphs", "shift+g", Group::progressive, "geomorphs on or off", toggle_geomorphs,
     need_progressive},
    {"toggle_automatic", "a", Group::progressive, "automatic level, by screen-space error",
     toggle_automatic, need_progressive},
    {"toggle_split_order_colors", "shift+b", Group::progressive, "color faces by split order",
     toggle_split_colors, need_progressive},
    {"keep_level", "k", Group::progressive, "use this level as the model", request_keep_level,
     need_progressive},

    {"toggle_info", "tab", Group::program, "show or hide the panels", toggle_info},
    {"toggle_help", "f1 h shift+/", Group::program, "show or hide this help", toggle_help},
    {"open_file", "ctrl+o", Group::program, "open a file (or drop one on the window)",
     toggle_open_dialog},
    {"save_file", "ctrl+s", Group::program, "save the model", show_save_dialog},
    {"screenshot", "f12", Group::program, "save a picture", request_screenshot},
    {"escape", "escape", Group::program, "cancel, close, clear the selection", escape},
    {"quit", "q", Group::program, "quit", quit},
};

void call(void (*function)(Session&), Session& session) {
  function(session);
}
void call(void (*function)(Document&), Session& session) {
  function(session.document);
}
void call(void (*function)(View&), Session& session) {
  function(session.view);
}

}  // namespace

std::span<const Command> commands() {
  return kCommands;
}

const Command* command_for(const KeyPress& key) {
  const auto found = std::ranges::find_if(kCommands, [&](const Command& command) {
    return std::ranges::count(parse_keys(command.keys), key) > 0;
  });
  return found == std::end(kCommands) ? nullptr : &*found;
}

const Command* command_named(std::string_view id) {
  const auto found =
      std::ranges::find_if(kCommands, [&](const Command& command) { return command.id == id; });
  return found == std::end(kCommands) ? nullptr : &*found;
}

void run(Session& session, const Command& command) {
  session.document.notice.clear();
  const char* reason = command.blocked != nullptr ? command.blocked(session.document) : nullptr;
  if (reason != nullptr) {
    session.document.notice = reason;
  } else {
    std::visit([&](auto* function) { call(function, session); }, command.function);
  }
}

void answer_question(Session& session, const KeyPress& key) {
  if (session.unsaved) {
    if (key.name == "s")
      answer_leave(session, LeaveAnswer::save);
    else if (key.name == kDiscardKey)
      answer_leave(session, LeaveAnswer::discard);
    else if (key.name == "escape")
      answer_leave(session, LeaveAnswer::cancel);
  } else {
    const bool can_restore = session.lost.front().problem.empty();
    if (key.name == "r" && can_restore)
      answer_lost(session, LostAnswer::restore);
    else if (key.name == kDiscardKey)
      answer_lost(session, LostAnswer::discard);
    else if (key.name == "escape")
      answer_lost(session, LostAnswer::later);
  }
}

void run(Session& session, std::string_view id) {
  const Command* command = command_named(id);
  MESHER_ASSERT(command != nullptr);
  run(session, *command);
}

}  // namespace mesher::app
