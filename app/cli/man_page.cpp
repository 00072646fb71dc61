#include "app/cli/man_page.h"

#include <fmt/format.h>

#include <cctype>

namespace mesher::app {
namespace {

/// Escapes a text for roff: backslashes, dashes that people copy, and a dot or quote that begins a
/// line, which would be a request.
std::string roff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n')) result += "\\&";
      result += c;
    }
  }
  return result;
}

std::string upper(std::string text) {
  for (char& c : text)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string header(const std::string& name, const std::string& what, const std::string& version) {
  return fmt::format(".TH {} 1 \"\" \"mesher {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n",
                     upper(roff(name)), version, roff(name), roff(what));
}

std::string argument(const ArgumentInfo& info) {
  std::string text = ".TP\n";
  for (std::size_t i = 0; i < info.names.size(); ++i)
    text += (i > 0 ? ", " : "") + fmt::format("\\fB{}\\fR", roff(info.names[i]));
  if (!info.value_name.empty())
    text += fmt::format("{}\\fI{}\\fR", info.names.empty() ? "" : " ", roff(info.value_name));
  text += '\n' + roff(info.help) + '\n';
  for (std::size_t i = 0; i < info.choices.size(); ++i) {
    const bool is_last = i + 1 == info.choices.size();
    text += fmt::format("{}\\fB{}\\fR{}",
                        i == 0             ? ".br\nOne of "
                        : i > 0 && is_last ? " or "
                                           : " ",
                        roff(info.choices[i]),
                        is_last                        ? ".\n"
                        : i + 2 == info.choices.size() ? ""
                                                       : ",");
  }
  return text;
}

std::string synopsis(const CommandInfo& command) {
  std::string text =
      fmt::format(".SH SYNOPSIS\n\\fBmesher {}\\fR [\\fIOPTIONS\\fR]", roff(command.name));
  for (const ArgumentInfo& info : command.positionals) {
    const std::string name = fmt::format("\\fI{}\\fR", info.value_name);
    text += info.is_required ? " " + name : " [" + name + "]";
  }
  return text + '\n';
}

/// Keeps each line of a text on a line of its own.
std::string lines(const std::string& text) {
  std::string result = ".nf\n" + roff(text);
  if (result.back() != '\n') result += '\n';
  return result + ".fi\n";
}

}  // namespace

std::string man_page(const CommandTable& table, const std::string& version) {
  std::string page = header("mesher", "mesh level-of-detail workbench", version);
  page +=
      ".SH SYNOPSIS\n\\fBmesher\\fR [\\fBview\\fR] \\fIMODEL\\fR\n.br\n"
      "\\fBmesher\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR] ...\n";
  page +=
      ".SH DESCRIPTION\nmesher opens triangle meshes, repairs defects, and shows them in a "
      "window or renders them without one. It simplifies, subdivides and compares them, and "
      "makes progressive meshes. The window and the commands do the same work.\n";
  page += ".SH COMMANDS\n";
  for (const CommandInfo& command : table.commands)
    page += fmt::format(".TP\n\\fB{}\\fR\n{}; see \\fBmesher\\-{}\\fR(1)\n", roff(command.name),
                        roff(command.help), roff(command.name));
  page += ".SH OPTIONS\n";
  for (const ArgumentInfo& info : table.program.options)
    page += argument(info);
  return page + ".SH NOTES\n" + lines(table.footer);
}

std::string man_page(const CommandTable& table, const CommandInfo& command,
                     const std::string& version) {
  std::string page = header("mesher-" + command.name, command.help, version) + synopsis(command);
  page += ".SH ARGUMENTS\n";
  for (const ArgumentInfo& info : command.positionals)
    page += argument(info);
  page += ".SH OPTIONS\n";
  for (const ArgumentInfo& info : command.options)
    page += argument(info);
  page += ".SH SEE ALSO\n\\fBmesher\\fR(1)";
  for (const CommandInfo& other : table.commands) {
    if (other.name != command.name) page += fmt::format(", \\fBmesher\\-{}\\fR(1)", other.name);
  }
  return page + '\n';
}

}  // namespace mesher::app
