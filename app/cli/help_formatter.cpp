#include "app/cli/help_formatter.h"

#include <sstream>

namespace mesher::app {
namespace {

constexpr std::size_t kColumns = 80;
constexpr std::size_t kNameColumn = 2;
constexpr std::size_t kTextColumn = 6;
constexpr std::size_t kCommandTextColumn = 15;

/// Breaks a text between words. `at`: the column where it starts; `indent`: the column where the
/// other lines start.
std::string wrapped(const std::string& text, std::size_t at, std::size_t indent) {
  std::string result;
  std::istringstream words(text);
  std::size_t column = at;
  for (std::string word; words >> word;) {
    if (column > at && column + 1 + word.size() > kColumns) {
      result += "\n" + std::string(indent, ' ');
      column = at = indent;
    } else if (column > at) {
      result += ' ';
      ++column;
    }
    result += word;
    column += word.size();
  }
  return result;
}

/// "{a,b,c}" with spaces, so that it can be wrapped.
std::string spaced(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == ',' && i + 1 < text.size() && text[i + 1] != ' ') text.insert(i + 1, 1, ' ');
  }
  return text;
}

}  // namespace

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  const std::string name =
      make_option_name(option, is_positional) + spaced(make_option_opts(option));
  return std::string(kNameColumn, ' ') + wrapped(name, kNameColumn, kTextColumn) + "\n" +
         std::string(kTextColumn, ' ') +
         wrapped(make_option_desc(option), kTextColumn, kTextColumn) + "\n";
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  std::string name = std::string(kNameColumn, ' ') + command->get_name();
  name.resize(std::max(name.size() + 1, kCommandTextColumn), ' ');
  return name + wrapped(command->get_description(), kCommandTextColumn, kCommandTextColumn) + "\n";
}

}  // namespace mesher::app
