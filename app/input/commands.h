#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "app/document/session.h"
#include "app/input/keys.h"

namespace mesher::app {

/// Where help lists a command.
enum class CommandGroup { look, simplify, subdivide, creases, progressive, program };
inline constexpr Choices<CommandGroup, 6> kCommandGroups{{
    {CommandGroup::look, {"look", "Look"}},
    {CommandGroup::simplify, {"simplify", "Simplify and undo"}},
    {CommandGroup::subdivide, {"subdivide", "Subdivide"}},
    {CommandGroup::creases, {"creases", "Creases"}},
    {CommandGroup::progressive, {"progressive", "Progressive mesh"}},
    {CommandGroup::program, {"program", "Files and window"}},
}};
static_assert(is_complete(kCommandGroups));
constexpr const auto& choices(CommandGroup) {
  return kCommandGroups;
}

/// Something a key, a button or a script can do: a row of the table of commands. Keys, help and
/// scripts take everything from its row. To add a command, write its function and add its row.
struct Command {
  const char* id;    ///< "toggle_wireframe": for scripts; never changes
  const char* keys;  ///< separated by spaces: "f1 h shift+/"
  CommandGroup group;
  const char* help;  ///< "show or hide the wireframe"
  /// Takes the part of the session that it needs.
  std::variant<void (*)(Session&), void (*)(Document&), void (*)(View&)> function;
  /// Returns why the command cannot run now, as a notice; null: it can run. A null pointer: the
  /// command can always run.
  const char* (*blocked)(const Document& document) = nullptr;
};

/// All commands, in the order in which help lists them.
std::span<const Command> commands();

/// The command that a key runs; null: none.
const Command* command_for(const KeyPress& key);

/// The command with this id; null: none.
const Command* command_named(std::string_view id);

/// Runs a command, or sets the notice to the reason why it cannot run now. Needs no window and no
/// GPU. Edits are only requested: the viewer or the script runs them (app/edit/edits.h).
void run(Session& session, const Command& command);

/// Answers the open question by a key: S saves, R restores, Delete discards, and Escape changes
/// nothing. Other keys do nothing. Pre: has_question(session).
void answer_question(Session& session, const KeyPress& key);

/// Runs the command with this id. Pre: there is one.
void run(Session& session, std::string_view id);

}  // namespace mesher::app
