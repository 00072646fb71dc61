#include "app/cli/command_table.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "engine/io/format.h"

namespace mesher::app {
namespace {

/// Options whose value is a file that mesher writes.
constexpr std::array<std::string_view, 4> kWritten{"output", "screenshot", "state-log", "turn-log"};

bool has_long_name(const CLI::Option& option, std::string_view name) {
  return std::ranges::find(option.get_lnames(), name) != option.get_lnames().end();
}

/// Returns the words of "TEXT:{quadric,qem,shape}".
std::vector<std::string> choices_of(const std::string& type) {
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  std::vector<std::string> words;
  std::string_view rest = std::string_view(type).substr(begin + 1, end - begin - 1);
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    words.emplace_back(rest.substr(0, comma));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return words;
}

/// Returns "N", "REAL" or "TEXT", whatever range CLI11 adds to the type.
std::string value_name_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::string word = type.substr(0, type.find(':'));
  if (word == "UINT" || word == "INT") return "N";
  return word == "FLOAT" ? "REAL" : word;
}

ValueKind kind_of(const CLI::Option& option, const ArgumentInfo& argument) {
  if (option.get_items_expected_max() == 0) return ValueKind::none;
  if (!argument.choices.empty()) return ValueKind::choice;
  const auto is_named = [&](std::string_view name) { return has_long_name(option, name); };
  if (std::ranges::any_of(kWritten, is_named)) return ValueKind::file;
  const bool is_model = option.get_positional() || is_named("input");
  return is_model ? ValueKind::model : ValueKind::text;
}

ArgumentInfo argument_of(const CLI::Option& option) {
  ArgumentInfo argument;
  for (const std::string& name : option.get_snames())
    argument.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames())
    argument.names.push_back("--" + name);
  argument.help = option.get_description();
  argument.choices = choices_of(option.get_type_name());
  argument.kind = kind_of(option, argument);
  if (argument.kind != ValueKind::none) argument.value_name = value_name_of(option);
  argument.is_required = option.get_required();
  return argument;
}

CommandInfo command_of(const CLI::App& app) {
  CommandInfo command{app.get_name(), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    ArgumentInfo argument = argument_of(*option);
    if (option->get_positional()) {
      ArgumentInfo positional = argument;
      positional.names.clear();
      positional.value_name = option->get_name(true, false);
      command.positionals.push_back(std::move(positional));
    }
    // A positional argument can be given by its name instead, so the name is never required.
    argument.is_required &= !option->get_positional();
    if (!argument.names.empty()) command.options.push_back(std::move(argument));
  }
  return command;
}

}  // namespace

CommandTable command_table(const CLI::App& app) {
  CommandTable table{command_of(app), {}, app.get_footer(), {}};
  for (const CLI::App* command : app.get_subcommands({}))
    table.commands.push_back(command_of(*command));
  for (const io::FormatInfo& format : io::formats())
    table.extensions.emplace_back(format.extension + 1);
  return table;
}

}  // namespace mesher::app
