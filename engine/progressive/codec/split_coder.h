#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "engine/core/array.h"
#include "engine/progressive/codec/pm_format.h"
#include "engine/progressive/codec/range_coder.h"
#include "engine/progressive/parent_fan.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::progressive {

/// Codes splits one after another with models that adapt to all of them. docs/pm-format.md
/// specifies the coded values. `Coder` is RangeEncoder or RangeDecoder, one per block.
template <class Coder>
class SplitCoder {
 public:
  /// `grid`: the quantized positions of the base; empty if coordinates are floats.
  SplitCoder(const PmHeader& header, Array<glm::ivec3>&& grid);
  ~SplitCoder();
  SplitCoder(const SplitCoder&) = delete;
  SplitCoder& operator=(const SplitCoder&) = delete;

  /// Reserves memory for so many splits in total.
  void reserve(std::uint32_t base_vertices, std::uint32_t splits);
  /// Begins a block with the splits [begin, end).
  void begin_block(std::uint32_t begin, std::uint32_t end);
  /// Encodes the split, or decodes into `split`. Returns what is wrong, or an empty string; a split
  /// decoded without error may be appended. Pre: `pm` is at the level before the split, and every
  /// earlier split was coded by this object.
  std::string_view code(Coder& coder, const ProgressiveMesh& pm, NewSplit& split);
  /// Returns the fan of the parent of the last coded split.
  ParentFan fan() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

extern template class SplitCoder<RangeEncoder>;
extern template class SplitCoder<RangeDecoder>;

}  // namespace mesher::progressive
