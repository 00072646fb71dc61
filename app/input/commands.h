#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/document/session.h"
#include "app/input/keys.h"

namespace mesher::app {

/// The menu that a command is in, and where help lists it.
enum class CommandGroup { file, edit, look, simplify, subdivide, creases, progressive, window };
inline constexpr Choices<CommandGroup, 8> kCommandGroups{{
    {CommandGroup::file, {"file", "File"}},
    {CommandGroup::edit, {"edit", "Edit"}},
    {CommandGroup::look, {"look", "View"}},
    {CommandGroup::simplify, {"simplify", "Simplify"}},
    {CommandGroup::subdivide, {"subdivide", "Subdivide"}},
    {CommandGroup::creases, {"creases", "Creases"}},
    {CommandGroup::progressive, {"progressive", "Levels"}},
    {CommandGroup::window, {"window", "Window"}},
}};
static_assert(is_complete(kCommandGroups));
constexpr const auto& choices(CommandGroup) {
  return kCommandGroups;
}

/// Something a key, a menu or a script can do: a row of the table of commands. Keys, menus, help
/// and scripts take everything from its row. To add a command, write its function and add its row.
struct Command {
  const char* id;    ///< "toggle_wireframe": for scripts; never changes
  const char* keys;  ///< separated by spaces: "f1 h shift+/"
  CommandGroup group;
  const char* label;  ///< in menus: "Wireframe"
  const char* help;   ///< "show or hide the wireframe"
  /// Takes the part of the session that it needs.
  std::variant<void (*)(Session&), void (*)(Document&), void (*)(View&)> function;
  /// Returns why the command cannot run now, as a notice; null: it can run. A null pointer: the
  /// command can always run.
  const char* (*blocked)(const Document& document) = nullptr;
  /// Returns whether what the command toggles is on, so that menus show a check mark. Null: the
  /// command is not a toggle.
  bool (*is_on)(const Session& session) = nullptr;
};

/// All commands, in the order in which help lists them.
std::span<const Command> commands();

/// The command that a key runs; null: none.
const Command* command_for(const KeyPress& key);

/// The command with this id; null: none.
const Command* command_named(std::string_view id);

/// Returns the keys as people read them: "Ctrl+Shift+Z, Ctrl+Y".
std::string keys_text(const Command& command);

/// Returns why the command cannot run now; null: it can.
const char* blocked(const Session& session, const Command& command);

/// Returns whether the command is a toggle that is on.
bool is_on(const Session& session, const Command& command);

/// Returns the commands that match all words of `filter` by name, help, id or group, best first.
std::vector<const Command*> matching_commands(std::string_view filter);

/// Runs a command, or sets the notice to the reason why it cannot run now. Needs no window and no
/// GPU. Edits are only requested: the viewer or the script runs them (app/edit/edits.h).
void run(Session& session, const Command& command);

/// Answers the open question by a key: S saves, R restores, Delete discards, and Escape changes
/// nothing. Other keys do nothing. Pre: has_question(session).
void answer_question(Session& session, const KeyPress& key);

/// Runs the command with this id. Pre: there is one.
void run(Session& session, std::string_view id);

}  // namespace mesher::app
