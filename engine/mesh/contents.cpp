#include "engine/mesh/contents.h"

#include <algorithm>

#include "engine/core/text.h"

namespace mesher {
namespace {

std::string readable_line(std::string_view text, std::size_t most_bytes) {
  return printable(text.substr(0, most_bytes));
}

}  // namespace

std::string FileContents::readable(std::string_view name) {
  return readable_line(name, kMostNameBytes);
}

void FileContents::note_attribute(const std::string& text) {
  const bool is_known =
      std::find(attributes_.begin(), attributes_.end(), text) != attributes_.end();
  if (!is_known && attributes_.size() < kMostNames) attributes_.push_back(text);
}

void FileContents::add(Content kind, std::string_view name) {
  ++(*this)[kind];
  std::vector<std::string>& names = names_[static_cast<std::size_t>(kind)];
  if (name.empty() || names.size() >= kMostNames) return;
  names.push_back(readable(name));
}

void FileContents::warn(std::string_view line) {
  // Room for a path and a name.
  if (warnings_.size() < kMostNames) warnings_.push_back(readable_line(line, 4 * kMostNameBytes));
}

std::string FileContents::phrase(Content kind, std::uint64_t count) const {
  std::string text = count_phrase(static_cast<std::int64_t>(count), describe(kind));
  // A message stays one line of a readable length.
  constexpr std::size_t kMostShown = 8;
  const std::vector<std::string>& all = names(kind);
  for (std::size_t i = 0; i < all.size() && i < kMostShown; ++i)
    text += (i == 0 ? ": " : ", ") + all[i];
  if (all.size() > kMostShown) text += ", ...";
  return text;
}

}  // namespace mesher
