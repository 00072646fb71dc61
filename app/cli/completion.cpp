#include "app/cli/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mesher::app {
namespace {

/// What each script says about itself, and who completes what.
constexpr const char* kOrigin = "# Made by the build of mesher from its table of commands.\n";

std::string joined(const std::vector<std::string>& words, const char* between) {
  return fmt::format("{}", fmt::join(words, between));
}

std::vector<std::string> names_of(const CommandTable& table) {
  std::vector<std::string> names;
  for (const CommandInfo& command : table.commands)
    names.push_back(command.name);
  return names;
}

/// Puts a backslash before each of some characters.
std::string escaped(const std::string& text, std::string_view characters) {
  std::string result;
  for (const char c : text) {
    if (characters.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

/// Puts a text into single quotes.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text)
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string bash_command(const CommandInfo& command) {
  std::vector<std::string> options;
  std::string values;
  for (const ArgumentInfo& option : command.options) {
    options.insert(options.end(), option.names.begin(), option.names.end());
    if (option.kind == ValueKind::none) continue;
    const std::string names = joined(option.names, "|");
    std::string action = "return";
    if (option.kind == ValueKind::choice)
      action = fmt::format("_mesher_words {}", quoted(joined(option.choices, " ")));
    if (option.kind == ValueKind::file) action = "_mesher_files ''";
    if (option.kind == ValueKind::model) action = "_mesher_files \"$models\"";
    values += fmt::format("        {}) {}; return ;;\n", names, action);
  }
  return fmt::format("    {})\n      case $previous in\n{}      esac\n      options={}\n      ;;\n",
                     command.name, values, quoted(joined(options, " ")));
}

/// Returns the positional arguments of a command for zsh: "1:MODEL:..." from the first.
std::string zsh_value(const ArgumentInfo& argument) {
  switch (argument.kind) {
    case ValueKind::none:
      return "";
    case ValueKind::text:
      return fmt::format(":{}: ", argument.value_name);
    case ValueKind::choice:
      return fmt::format(":{}:({})", argument.value_name, joined(argument.choices, " "));
    case ValueKind::file:
      return ":file:_files";
    case ValueKind::model:
      return ":model:_mesher_models";
  }
  return "";
}

std::string zsh_command(const CommandInfo& command) {
  std::string text = fmt::format("    {})\n      _arguments -S", command.name);
  for (const ArgumentInfo& option : command.options) {
    const std::string help = escaped(option.help, "[]:\\");
    for (const std::string& name : option.names)
      text += " \\\n        " + quoted(fmt::format("{}[{}]{}", name, help, zsh_value(option)));
  }
  for (const ArgumentInfo& argument : command.positionals)
    text += " \\\n        " + quoted(zsh_value(argument));
  return text + "\n      ;;\n";
}

std::string fish_option(const std::string& condition, const ArgumentInfo& option) {
  std::string text = "complete -c mesher -n " + quoted(condition);
  for (const std::string& name : option.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (option.kind == ValueKind::text) text += " -x";
  if (option.kind == ValueKind::choice) text += " -x -a " + quoted(joined(option.choices, " "));
  if (option.kind == ValueKind::file) text += " -r -F";
  if (option.kind == ValueKind::model) text += " -x -a '(__mesher_models)'";
  return text + " -d " + quoted(option.help) + "\n";
}

}  // namespace

std::string bash_completion(const CommandTable& table) {
  std::string text = kOrigin;
  text +=
      "_mesher_words() {\n  COMPREPLY=($(compgen -W \"$1\" -- \"$current\"))\n}\n\n"
      "# Completes folders, and files with one of these extensions; none: all files.\n"
      "_mesher_files() {\n  local IFS=$'\\n' extension\n  compopt -o filenames 2>/dev/null\n"
      "  if [ -z \"$1\" ]; then\n    COMPREPLY=($(compgen -f -- \"$current\"))\n    return\n"
      "  fi\n  COMPREPLY=($(compgen -d -- \"$current\"))\n  IFS=' '\n"
      "  for extension in $1; do\n    IFS=$'\\n'\n"
      "    COMPREPLY+=($(compgen -f -X \"!*.$extension\" -- \"$current\"))\n  done\n}\n\n";
  text += fmt::format(
      "_mesher() {{\n  local current=${{COMP_WORDS[COMP_CWORD]}} "
      "previous=${{COMP_WORDS[COMP_CWORD-1]}}\n"
      "  local commands='{}' models='{}' command=${{COMP_WORDS[1]}} options\n  COMPREPLY=()\n"
      "  case \" $commands \" in\n    *\" $command \"*) ;;\n    *) command=view ;;\n  esac\n"
      "  case $command in\n",
      joined(names_of(table), " "), joined(table.extensions, " "));
  for (const CommandInfo& command : table.commands)
    text += bash_command(command);
  text += "  esac\n  if [[ $current == -* ]]; then\n";
  std::vector<std::string> own;
  for (const ArgumentInfo& option : table.program.options)
    own.insert(own.end(), option.names.begin(), option.names.end());
  text += fmt::format("    [ \"$COMP_CWORD\" -eq 1 ] && options+=' {}'\n", joined(own, " "));
  text +=
      "    _mesher_words \"$options\"\n    return\n  fi\n  _mesher_files \"$models\"\n"
      "  [ \"$COMP_CWORD\" -eq 1 ] && COMPREPLY+=($(compgen -W \"$commands\" -- \"$current\"))\n"
      "  return 0\n}\ncomplete -F _mesher mesher\n";
  return text;
}

std::string zsh_completion(const CommandTable& table) {
  std::string text = "#compdef mesher\n";
  text += kOrigin;
  text += fmt::format(
      "_mesher_models() {{\n  _files -g '*.({})(-.)'\n}}\n\n_mesher() {{\n"
      "  local -a commands\n  commands=(\n",
      joined(table.extensions, "|"));
  for (const CommandInfo& command : table.commands)
    text += "    " + quoted(command.name + ":" + escaped(command.help, ":\\")) + "\n";
  text +=
      "  )\n  if (( CURRENT == 2 )) && [[ $words[2] != -* ]]; then\n"
      "    _describe command commands\n    _mesher_models\n    return\n  fi\n"
      "  local command=view\n"
      "  if (( ${commands[(I)$words[2]:*]} )); then\n    command=$words[2]\n    shift words\n"
      "    (( CURRENT-- ))\n  fi\n  case $command in\n";
  for (const CommandInfo& command : table.commands)
    text += zsh_command(command);
  return text + "  esac\n}\n\n_mesher \"$@\"\n";
}

std::string fish_completion(const CommandTable& table) {
  std::string text = kOrigin;
  text += fmt::format(
      "function __mesher_models\n  for file in (__fish_complete_path "
      "(commandline -ct))\n    string match -qr '(/|\\.({}))(\\t|$)' -- $file; and "
      "echo $file\n  end\nend\n",
      joined(table.extensions, "|"));
  const std::string names = joined(names_of(table), " ");
  const std::string none = "not __fish_seen_subcommand_from " + names;
  text += "complete -c mesher -f\ncomplete -c mesher -a '(__mesher_models)'\n";
  for (const ArgumentInfo& option : table.program.options)
    text += fish_option(none, option);
  for (const CommandInfo& command : table.commands) {
    text += fmt::format("complete -c mesher -n {} -a {} -d {}\n", quoted(none), command.name,
                        quoted(command.help));
  }
  for (const CommandInfo& command : table.commands) {
    std::string condition = "__fish_seen_subcommand_from " + command.name;
    if (command.name == "view") condition += "; or " + none;
    for (const ArgumentInfo& option : command.options)
      text += fish_option(condition, option);
  }
  return text;
}

}  // namespace mesher::app
