#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/mesh/geomorph.h"
#include "engine/progressive/progressive_attributes.h"

namespace mesher::progressive {

/// Data of the geomorph of attributes. A wedge is drawn with the values that it has in the level,
/// minus what the growing splits have not added yet; a new wedge starts with the values of the
/// wedge that its corners had before. A wedge of new faces only starts with its own, since those
/// faces have no area yet. See WedgeMorph.
///
/// Layers whose values may be blended take part (can_blend), the first ones up to kMostNumbers.
class AttributeMorph {
 public:
  static constexpr std::size_t kMostNumbers = 30;  ///< per value of all layers

  AttributeMorph() = default;
  /// For all splits, at the attributes' current level; `attributes` ends at the level it had. O(W *
  /// values). Throws Cancelled.
  explicit AttributeMorph(ProgressiveAttributes& attributes, Progress* progress = nullptr);

  /// Updates the heads to the level of `attributes`. They change only for wedges that its changes()
  /// list for the same steps. O(steps).
  void follow(const ProgressiveAttributes& attributes);

  /// What the GPU and `morphed_value` read.
  WedgeMorph view() const { return {heads_, words_, stride_, first_word_}; }

 private:
  void begin(const ProgressiveAttributes& attributes, std::uint32_t split);
  void end(const ProgressiveAttributes& attributes, std::uint32_t first);
  template <class Visit>
  void for_each_number(const ProgressiveAttributes& attributes, std::uint32_t change, Wedge w,
                       Visit visit);

  std::uint32_t level_ = 0;
  std::uint32_t stride_ = 0;
  std::vector<std::uint32_t> first_word_;
  Array<std::uint32_t> first_change_;  ///< by split, and the end
  Array<Wedge> changes_;               ///< the wedge of each
  Array<std::uint32_t> heads_;
  Array<std::uint32_t> words_;
};

}  // namespace mesher::progressive
