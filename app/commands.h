#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "app/keys.h"
#include "app/session.h"

namespace mesher::app {

/// Everything a key can do. Buttons and menus run the same commands.
enum class Command {
  toggle_wireframe,
  toggle_surface,
  toggle_gouraud,
  toggle_background,
  view_front,
  view_right,
  view_top,
  toggle_orthographic,
  frame_model,
  simplify,
  simplify_edge,
  subdivide,
  coarsen,
  toggle_limit,
  next_scheme,
  toggle_crease_rules,
  undo,
  redo,
  toggle_creases,
  tag_creases,
  select_creases,
  sharpen,
  smoothen,
  sharpen_fully,
  clear_creases,
  toggle_progressive,
  play,
  one_split_down,
  one_split_up,
  detail_down,
  detail_up,
  least_detail,
  most_detail,
  toggle_geomorphs,
  toggle_automatic,
  toggle_split_order_colors,
  keep_level,
  toggle_info,
  toggle_help,
  open_file,
  save_file,
  screenshot,
  escape,
  quit,
};

/// A command with its keys, as help lists them.
struct Binding {
  Command command;
  std::string_view keys;  ///< between spaces, the first is the one to show: "f1 h shift+/"
  std::string_view what;  ///< "wireframe on and off"
};

/// In the order in which help lists them.
std::span<const Binding> bindings();

/// What a key does, if anything.
std::optional<Command> command_for(const KeyPress& key);

/// Runs a command. Needs no window and no GPU.
void run(Session& session, Command command);

}  // namespace mesher::app
