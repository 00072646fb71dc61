#include "app/files/command_line.h"

#include <fmt/format.h>

#include "app/files/save.h"

namespace mesher::app {
namespace {

/// Quotes a word for a POSIX shell if it has characters that mean something there.
std::string shell_quoted(const std::string& word) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./+,:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word)
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string reading_options(const ModelSource& source) {
  std::string text;
  if (source.crease_index_base)
    text += fmt::format(" --crease-index-base {}", *source.crease_index_base);
  if (source.keep_isolated_vertices) text += " --keep-isolated";
  if (!source.weld) text += " --no-weld";
  if (source.weld.value_or(0.0) > 0.0) text += fmt::format(" --weld {}", *source.weld);
  // The shortest text that reads back as the same float.
  if (source.tag_creases_deg) text += fmt::format(" --tag-creases {}", *source.tag_creases_deg);
  return text;
}

}  // namespace

std::string command_line(const Document& document) {
  const History& history = document.edits.history;
  std::string edits;
  for (std::size_t i = 0; i < history.done_steps(); ++i) {
    if (i > 0) edits += "; ";
    edits += history.steps()[i].text;
  }
  return fmt::format("mesher edit {}{} -o {} --do {}", shell_quoted(document.file.string()),
                     reading_options(document.source),
                     shell_quoted(suggested_file(document).string()), shell_quoted(edits));
}

}  // namespace mesher::app
