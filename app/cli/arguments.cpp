#include "app/cli/arguments.h"

#include <fmt/format.h>

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

/// The number of letters to insert, remove, replace or swap with their neighbor (the optimal string
/// alignment distance).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = i + j;
        continue;
      }
      const std::size_t replaced = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replaced});
      const bool is_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swapped) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace

std::string nearest_name(const std::string& word, const std::vector<std::string>& names) {
  constexpr std::size_t kMostLetters = 64;
  std::string nearest;
  std::size_t least = 3;
  if (word.size() > kMostLetters) return nearest;
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(word, name);
    if (distance >= least || 2 * distance >= name.size()) continue;
    least = distance;
    nearest = name;
  }
  return nearest;
}

std::vector<std::string> suggestions(const std::vector<std::string>& arguments,
                                     const std::vector<std::string>& long_options) {
  std::vector<std::string> lines;
  for (const std::string& argument : arguments) {
    if (argument == "--") break;  // the rest are file names
    const std::size_t first = argument.find_first_not_of('-');
    if (first == 0 || first == std::string::npos) continue;
    const std::string name = argument.substr(first, argument.find('=') - first);
    if (contains(long_options, name)) continue;
    const std::string meant = nearest_name(name, long_options);
    // In the person's own style: -gourad is answered with -gouraud.
    const char* const dashes = first == 1 ? "-" : "--";
    if (!meant.empty())
      lines.push_back(fmt::format("{}: did you mean {}{}?", argument, dashes, meant));
  }
  return lines;
}

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
