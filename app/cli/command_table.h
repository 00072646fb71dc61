#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace mesher::app {

/// What an argument of the command line is, as far as a shell can complete it.
enum class ValueKind {
  none,    ///< a flag: there is no value
  text,    ///< cannot be completed
  choice,  ///< one of some words
  file,    ///< any file
  model,   ///< a file that mesher can open
};

/// An option or a positional argument.
struct ArgumentInfo {
  std::vector<std::string> names;  ///< with dashes: "-o", "--output"; empty: positional
  std::string value_name;          ///< "MODEL", "TEXT", "WxH"; empty: there is no value
  std::string help;
  ValueKind kind = ValueKind::none;
  std::vector<std::string> choices;
  bool is_required = false;
};

/// A command with its arguments; the program itself has an empty name.
struct CommandInfo {
  std::string name;
  std::string help;
  std::vector<ArgumentInfo> positionals;
  std::vector<ArgumentInfo> options;
};

/// The command line as data, from which man pages and completions are made.
struct CommandTable {
  CommandInfo program;
  std::vector<CommandInfo> commands;
  std::string footer;                   ///< below the help of the program
  std::vector<std::string> extensions;  ///< of models, without dots
};

/// Returns the table of a grammar.
CommandTable command_table(const CLI::App& app);

/// Returns the table of the program's own grammar.
CommandTable command_table();

}  // namespace mesher::app
