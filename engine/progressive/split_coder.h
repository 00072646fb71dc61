#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "engine/core/array.h"
#include "engine/progressive/pm_format.h"
#include "engine/progressive/progressive_mesh.h"
#include "engine/progressive/range_coder.h"

namespace mesher {

/// Codes splits one after another with models that learn from all of them; what is said of each is
/// in docs/pm-format.md. `Coder` is RangeEncoder or RangeDecoder, one a block.
template <class Coder>
class SplitCoder {
 public:
  /// `grid`: the numbers of the base's positions, empty where coordinates are floats.
  SplitCoder(const PmHeader& header, Array<glm::ivec3>&& grid);
  ~SplitCoder();
  SplitCoder(const SplitCoder&) = delete;
  SplitCoder& operator=(const SplitCoder&) = delete;

  /// Splits [begin, end) are in the block that begins.
  void begin_block(std::uint32_t begin, std::uint32_t end);
  /// Encodes the split, or decodes it into `split`. Returns why it cannot be, empty where it can:
  /// decoded, it may be appended then. Pre: `pm` is at the level before it, and every split
  /// before it went through here.
  std::string_view code(Coder& coder, const ProgressiveMesh& pm, NewSplit& split);
  /// Around the parent of the split that was coded last.
  ParentFan fan() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

extern template class SplitCoder<RangeEncoder>;
extern template class SplitCoder<RangeDecoder>;

}  // namespace mesher
