#include "app/cli/arguments.h"

#include <algorithm>

namespace mesher::app {
namespace {

bool contains(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

// "-size" and "-size=500", but not "-o" (a short option), "-oy.obj" or "-30,20" (a value).
bool is_one_dash_name(const std::string& argument, const std::vector<std::string>& long_options) {
  if (argument.size() <= 2 || argument[0] != '-') return false;
  return contains(long_options, argument.substr(1, argument.find('=') - 1));
}

}  // namespace

std::vector<std::string> normalized_arguments(std::vector<std::string> arguments,
                                              const std::vector<std::string>& commands,
                                              const std::vector<std::string>& long_options) {
  for (std::string& argument : arguments) {
    if (argument == "--") break;  // the rest are file names
    if (is_one_dash_name(argument, long_options)) argument.insert(0, 1, '-');
  }
  const auto speaks_of_program = [](const std::string& argument) {
    return argument == "-h" || argument == "--help" || argument == "--version";
  };
  const bool names_command =
      !arguments.empty() && (contains(commands, arguments[0]) || speaks_of_program(arguments[0]));
  if (!names_command) arguments.insert(arguments.begin(), "view");
  return arguments;
}

}  // namespace mesher::app
