#include "app/cli/arguments.h"

#include <algorithm>
#include <cctype>

namespace mesher::app {
namespace {

// "-size", but not "-o" (a short option), "-30,20" (a value) or "--size".
bool is_one_dash_name(const std::string& argument) {
  return argument.size() > 2 && argument[0] == '-' &&
         std::isalpha(static_cast<unsigned char>(argument[1])) != 0;
}

}  // namespace

std::vector<std::string> normalized_arguments(std::vector<std::string> arguments,
                                              const std::vector<std::string>& commands) {
  for (std::string& argument : arguments) {
    if (argument == "--") break;  // what follows are names, whatever they look like
    if (is_one_dash_name(argument)) argument.insert(0, 1, '-');
  }
  const auto speaks_of_program = [](const std::string& argument) {
    return argument == "-h" || argument == "--help" || argument == "--version";
  };
  const bool names_command = !arguments.empty() && (std::find(commands.begin(), commands.end(),
                                                              arguments[0]) != commands.end() ||
                                                    speaks_of_program(arguments[0]));
  if (!names_command) arguments.insert(arguments.begin(), "view");
  return arguments;
}

}  // namespace mesher::app
