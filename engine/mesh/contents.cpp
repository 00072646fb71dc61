#include "engine/mesh/contents.h"

#include "engine/core/text.h"

namespace mesher {

void FileContents::add(Content kind, std::string_view name) {
  ++(*this)[kind];
  std::vector<std::string>& names = names_[static_cast<std::size_t>(kind)];
  if (name.empty() || names.size() >= kMostNames) return;
  std::string kept(name.substr(0, kMostNameBytes));
  for (char& c : kept) {
    if (static_cast<unsigned char>(c) < ' ') c = '_';
  }
  names.push_back(std::move(kept));
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
