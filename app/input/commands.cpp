#include "app/input/commands.h"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "app/document/meshes.h"
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
    {"open_file", "ctrl+o", Group::file, "Open...", "open a file (or drop one on the window)",
     toggle_open_dialog},
    {"save_file", "ctrl+s", Group::file, "Save...", "save the model", show_save_dialog},
    {"screenshot", "f12", Group::file, "Save a picture", "save a picture of the window's size",
     request_screenshot},
    {"picture", "shift+f12", Group::file, "Picture or turntable...",
     "save a picture of another size, transparent, or a turntable", show_picture_options},
    {"close_model", "ctrl+w", Group::file, "Close", "close the model", close_model},
    {"quit", "q", Group::file, "Quit", "quit", quit},

    {"undo", "ctrl+z", Group::edit, "Undo", "undo", request_undo, need_undo},
    {"redo", "ctrl+shift+z ctrl+y", Group::edit, "Redo", "redo", request_redo, need_redo},
    {"copy_command_line", "ctrl+shift+c", Group::edit, "Copy as command line",
     "copy the mesher command that makes these edits", copy_command_line, need_edits},

    {"toggle_wireframe", "w", Group::look, "Wireframe", "show or hide the wireframe",
     toggle_wireframe, nullptr, shows_wireframe},
    {"toggle_surface", "shift+w", Group::look, "Surface", "show or hide the surface",
     toggle_surface, nullptr, shows_surface},
    {"toggle_gouraud", "g", Group::look, "Gouraud shading", "Gouraud or flat shading",
     toggle_gouraud, nullptr, shows_gouraud},
    {"next_look", "t", Group::look, "Next look",
     "next look: material, clay, base color, normals, UV checker", next_look},
    {"toggle_background", "b", Group::look, "Dark background", "light or dark background",
     toggle_background, nullptr, is_dark},
    {"next_normal_weight", "n", Group::look, "Weights of normals",
     "weights of Gouraud normals: angle, area, uniform", next_normal_weight},
    {"view_front", "1", Group::look, "Front view", "view from the front",
     set_view<render::View::front>},
    {"view_right", "3", Group::look, "Right view", "view from the right",
     set_view<render::View::right>},
    {"view_top", "7", Group::look, "Top view", "view from above", set_view<render::View::top>},
    {"toggle_orthographic", "5", Group::look, "Orthographic", "orthographic or perspective",
     toggle_orthographic, nullptr, is_orthographic},
    {"frame_model", "f", Group::look, "Whole model", "show the whole model", frame_model},
    {"isolate_mesh", "shift+i", Group::look, "Isolate mesh", "show the chosen mesh of a scene only",
     isolate_chosen, need_chosen},
    {"show_all", "shift+v", Group::look, "Show all nodes", "show all nodes of a scene",
     show_all_nodes, need_hidden},

    {"simplify", "d", Group::simplify, "Remove 10 %", "remove 10 % of the faces",
     request_remove_tenth, need_model},
    {"simplify_edge", "shift+d", Group::simplify, "Collapse one edge", "collapse one edge",
     request_collapse_edge, need_model},

    {"subdivide", "s", Group::subdivide, "Subdivide", "subdivide: each face becomes four",
     request_subdivide, need_model},
    {"coarsen", "shift+s", Group::subdivide, "Previous level", "previous level",
     request_previous_level, need_model},
    {"toggle_limit", "l", Group::subdivide, "Limit surface", "limit surface on or off",
     toggle_limit, nullptr, shows_limit},
    {"next_scheme", "m", Group::subdivide, "Next scheme", "next scheme: Loop, butterfly, midpoint",
     next_scheme},
    {"toggle_crease_rules", "r", Group::subdivide, "Crease rules", "crease rules: Hoppe or DeRose",
     toggle_crease_rules},

    {"toggle_creases", "c", Group::creases, "Edit creases", "edit creases: clicks select edges",
     toggle_creases, nullptr, edits_creases},
    {"sharpen", "+", Group::creases, "Sharper", "make selected edges sharper by 1", sharpen},
    {"smoothen", "-", Group::creases, "Smoother", "make selected edges smoother by 1", smoothen},
    {"sharpen_fully", "i", Group::creases, "Infinitely sharp",
     "make selected edges infinitely sharp", sharpen_fully},
    {"clear_creases", "x delete", Group::creases, "Smooth", "make selected edges smooth",
     make_smooth},
    {"select_creases", "ctrl+a", Group::creases, "Select all creases", "select all creases",
     select_sharp_edges},
    {"tag_creases", "shift+c", Group::creases, "Mark by angle",
     "mark creases by the angle set in the panel", mark_creases_by_angle},

    {"toggle_progressive", "p", Group::progressive, "Progressive mode",
     "progressive mode on or off", toggle_progressive, nullptr, is_progressive},
    {"play", "space", Group::progressive, "Play or pause",
     "play or pause: levels of detail, or an animation of the model", play, need_player},
    {"detail_up", "pageup shift+]", Group::progressive, "More detail", "more detail, by a tenth",
     detail_up, need_progressive},
    {"detail_down", "pagedown shift+[", Group::progressive, "Less detail",
     "less detail, by a tenth", detail_down, need_progressive},
    {"one_split_up", "] .", Group::progressive, "One split more", "one more vertex split",
     one_split_up, need_progressive},
    {"one_split_down", "[ ,", Group::progressive, "One split fewer", "one vertex split fewer",
     one_split_down, need_progressive},
    {"most_detail", "end", Group::progressive, "Full detail", "full detail", most_detail,
     need_progressive},
    {"least_detail", "home", Group::progressive, "Coarsest level", "the coarsest level",
     least_detail, need_progressive},
    {"toggle_geomorphs", "shift+g", Group::progressive, "Geomorphs", "geomorphs on or off",
     toggle_geomorphs, need_progressive, has_progressive<&ProgressiveSettings::geomorphs>},
    {"toggle_automatic", "a", Group::progressive, "Automatic level",
     "automatic level, by screen-space error", toggle_automatic, need_progressive,
     has_progressive<&ProgressiveSettings::is_automatic>},
    {"toggle_split_order_colors", "shift+b", Group::progressive, "Split order colors",
     "color faces by split order", toggle_split_colors, need_progressive,
     has_progressive<&ProgressiveSettings::colors_by_split_order>},
    {"keep_level", "k", Group::progressive, "Use this level", "use this level as the model",
     request_keep_level, need_progressive},

    {"toggle_info", "tab", Group::window, "Panels", "show or hide the panels", toggle_info, nullptr,
     shows_panels},
    {"toggle_help", "f1 h shift+/", Group::window, "Help", "show or hide this help", toggle_help,
     nullptr, shows_help},
    {"escape", "escape", Group::window, "Cancel or close", "cancel, close, clear the selection",
     escape},
    {"next_tab", "ctrl+pagedown", Group::window, "Next model", "show the next open model",
     show_next_tab, need_rest},
    {"previous_tab", "ctrl+pageup", Group::window, "Previous model", "show the previous open model",
     show_previous_tab, need_rest},
    {"find_command", "ctrl+k", Group::window, "Find a command...", "find a command by its name",
     toggle_palette},
    {"tool_model", "ctrl+1", Group::window, "Model", "show the panel: the model and its history",
     show_tool<Tool::model>, nullptr, shows_tool<Tool::model>},
    {"tool_look", "ctrl+2", Group::window, "Look", "show the panel: shading, lines, colors",
     show_tool<Tool::look>, nullptr, shows_tool<Tool::look>},
    {"tool_simplify", "ctrl+3", Group::window, "Simplify", "show the panel: simplification",
     show_tool<Tool::simplify>, nullptr, shows_tool<Tool::simplify>},
    {"tool_subdivide", "ctrl+4", Group::window, "Subdivide", "show the panel: subdivision",
     show_tool<Tool::subdivide>, nullptr, shows_tool<Tool::subdivide>},
    {"tool_creases", "ctrl+5", Group::window, "Creases", "show the panel: creases",
     show_tool<Tool::creases>, nullptr, shows_tool<Tool::creases>},
    {"tool_levels", "ctrl+6", Group::window, "Levels", "show the panel: progressive mesh",
     show_tool<Tool::levels>, nullptr, shows_tool<Tool::levels>},
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

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return lower;
}

std::string searched_text(const Command& command) {
  return lower_case(std::string(command.label) + ' ' + command.help + ' ' + command.id + ' ' +
                    text_of(command.group).label + ' ' + keys_text(command));
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

std::string keys_text(const Command& command) {
  std::string text;
  for (const KeyPress& key : parse_keys(command.keys)) {
    if (!text.empty()) text += ", ";
    text += key == KeyPress{"/", true, false} ? "?" : to_text(key);
  }
  return text;
}

const char* blocked(const Session& session, const Command& command) {
  return command.blocked != nullptr ? command.blocked(session.document) : nullptr;
}

bool is_on(const Session& session, const Command& command) {
  return command.is_on != nullptr && command.is_on(session);
}

std::vector<const Command*> matching_commands(std::string_view filter) {
  std::istringstream parts(lower_case(filter));
  const std::vector<std::string> words(std::istream_iterator<std::string>(parts), {});
  std::vector<const Command*> found;
  for (const Command& command : kCommands) {
    const std::string text = searched_text(command);
    if (std::ranges::all_of(
            words, [&](const std::string& word) { return text.find(word) != std::string::npos; }))
      found.push_back(&command);
  }
  // Names come before explanations.
  std::stable_partition(found.begin(), found.end(), [&](const Command* command) {
    return words.empty() || lower_case(command->label).starts_with(words.front());
  });
  return found;
}

void run(Session& session, const Command& command) {
  session.document.notice.clear();
  const char* reason = blocked(session, command);
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
