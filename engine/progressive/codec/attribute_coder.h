#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "engine/progressive/codec/attribute_table.h"
#include "engine/progressive/codec/pm_format.h"
#include "engine/progressive/codec/range_coder.h"
#include "engine/progressive/progressive_attributes.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::progressive {

/// What the parts of the attributes take in a file, in bits.
struct AttributeBits {
  double wedges = 0.0;  ///< which corners share values
  double groups = 0.0;
  std::vector<double> layers;
};

/// Codes the attributes of a base and of splits one after another, with models that adapt to all of
/// them, and builds them. docs/pm-format.md specifies the coded values. `Coder` is RangeEncoder or
/// RangeDecoder, one per block. An encoder builds them too: as a reader will have them, which is
/// not what it was given if values are rounded.
template <class Coder>
class AttributeCoder {
 public:
  /// `built` becomes the attributes that are coded. `source`: those to be encoded; null for a
  /// decoder. Both outlive this.
  AttributeCoder(const PmHeader& header, AttributeTable&& table, ProgressiveAttributes& built,
                 const ProgressiveAttributes* source);
  ~AttributeCoder();
  AttributeCoder(const AttributeCoder&) = delete;
  AttributeCoder& operator=(const AttributeCoder&) = delete;

  /// Reserves memory for so many splits in total.
  void reserve(std::uint32_t splits);
  /// Codes the attributes of the base. Returns what is wrong, or an empty string. Pre: `source` is
  /// at its base. `bytes`: size of the payload; ignored by an encoder.
  std::string_view code_base(Coder& coder, const Mesh& base, std::uint64_t bytes);
  /// Begins a block that ends with split `end`. `bytes`: size of its payload; ignored by an
  /// encoder.
  void begin_block(std::uint32_t end, std::uint64_t bytes);
  /// Codes what the last split of `mesh` does to the attributes, and appends it to them. Returns
  /// what is wrong, or an empty string; the attributes are unchanged unless it is empty. Throws
  /// std::bad_alloc. Pre: `mesh` is at the level after the split; so is `source`.
  std::string_view code_split(Coder& coder, const ProgressiveMesh& mesh);
  /// Encoder only. Returns the least number of bytes that the payload may have, see
  /// kPmValueBytesPerByte.
  std::uint64_t least_bytes() const;
  /// Encoder only. Says how many bytes the payload got.
  void note_bytes(std::uint64_t bytes);

  /// Encoder only.
  const AttributeBits& bits() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

extern template class AttributeCoder<RangeEncoder>;
extern template class AttributeCoder<RangeDecoder>;

}  // namespace mesher::progressive
