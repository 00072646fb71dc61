#include "engine/progressive/attribute_morph.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/core/parallel.h"

namespace mesher::progressive {
namespace {

constexpr std::uint32_t kMorphsBetweenReports = 1U << 14;
constexpr std::uint32_t kWordsBeforeValues = 2;

}  // namespace

AttributeMorph::AttributeMorph(ProgressiveAttributes& attributes, Progress* progress) {
  stride_ = kWordsBeforeValues;
  for (const AttributeLayer& layer : attributes.layers()) {
    const bool takes_part = can_blend(layer.type()) &&
                            stride_ + layer.type().components <= kWordsBeforeValues + kMostNumbers;
    first_word_.push_back(takes_part ? stride_ : 0);
    stride_ += takes_part ? layer.type().components : 0;
  }
  if (stride_ == kWordsBeforeValues) return;
  const std::uint32_t level = attributes.level();
  attributes.go_to(0);
  heads_.assign(attributes.wedge_count(attributes.split_count()), kNoHead);
  for (std::uint32_t i = 0; i < attributes.split_count(); ++i) {
    first_change_.push_back(static_cast<std::uint32_t>(changes_.size()));
    begin(attributes, i);
    attributes.go_to(i + 1);
    end(attributes, first_change_.back());
    if (i % kMorphsBetweenReports == 0)
      report(progress, static_cast<float>(i) / static_cast<float>(attributes.split_count()));
  }
  first_change_.push_back(static_cast<std::uint32_t>(changes_.size()));
  level_ = attributes.split_count();
  attributes.go_to(level);
  follow(attributes);
}

/// Calls `visit(value, word)` for each number of a wedge that takes part, and its word in a change.
template <class Visit>
void AttributeMorph::for_each_number(const ProgressiveAttributes& attributes, std::uint32_t change,
                                     Wedge w, Visit visit) {
  std::uint32_t* const words = &words_[std::size_t{stride_} * change];
  for (std::size_t k = 0; k < first_word_.size(); ++k) {
    if (first_word_[k] == 0) continue;
    const AttributeLayer& layer = attributes.layers()[k];
    const AttributeValue value = load(layer, w.index());
    for (std::size_t c = 0; c < layer.type().components; ++c)
      visit(static_cast<float>(value[c]), words[first_word_[k] + c]);
  }
}

/// Begins the changes of a split with the values before it. Pre: the attributes are at its coarser
/// level.
void AttributeMorph::begin(const ProgressiveAttributes& attributes, std::uint32_t split) {
  const std::uint32_t first_new = attributes.wedge_count(split);
  const auto change = [&](Wedge w, Wedge from) {
    const auto id = static_cast<std::uint32_t>(changes_.size());
    changes_.push_back(w);
    words_.insert(words_.end(), {split, heads_[from.index()]});
    words_.resize(std::size_t{stride_} * (id + 1));
    for_each_number(attributes, id, from, [](float value, std::uint32_t& word) {
      word = std::bit_cast<std::uint32_t>(value);
    });
  };
  for (const Wedge w : attributes.changed_wedges(split))
    change(w, w);
  for (const CornerChange& corner : attributes.corner_changes(split)) {
    const std::span<const Wedge> known = std::span(changes_).subspan(first_change_.back());
    if (corner.other.index() < first_new || std::ranges::find(known, corner.other) != known.end())
      continue;
    change(corner.other, attributes.corner_wedges()[corner.corner.index()]);
  }
}

/// Ends the changes from `first` on with the values after the split.
void AttributeMorph::end(const ProgressiveAttributes& attributes, std::uint32_t first) {
  for (auto id = first; id < changes_.size(); ++id) {
    for_each_number(attributes, id, changes_[id], [](float value, std::uint32_t& word) {
      const float difference = value - std::bit_cast<float>(word);
      // Absent values do not move.
      word = std::bit_cast<std::uint32_t>(std::isfinite(difference) ? difference : 0.0F);
    });
    heads_[changes_[id].index()] = id;
  }
}

void AttributeMorph::follow(const ProgressiveAttributes& attributes) {
  if (heads_.empty()) return;
  const auto changes_of = [&](std::uint32_t split) {
    return IndexRange{first_change_[split], first_change_[split + 1]};
  };
  for (; level_ < attributes.level(); ++level_) {
    for (auto [id, last] = changes_of(level_); id < last; ++id)
      heads_[changes_[id].index()] = static_cast<std::uint32_t>(id);
  }
  for (; level_ > attributes.level(); --level_) {
    // The heads of wedges that the coarser level does not have stay those of their first change.
    const std::uint32_t first_new = attributes.wedge_count(level_ - 1);
    for (auto [id, last] = changes_of(level_ - 1); id < last; ++id) {
      if (changes_[id].index() < first_new)
        heads_[changes_[id].index()] = words_[std::size_t{stride_} * id + 1];
    }
  }
}

}  // namespace mesher::progressive
