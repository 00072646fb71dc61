#pragma once

#include <cstdint>

#include "engine/mesh/ids.h"
#include "engine/progressive/codec/range_coder.h"

namespace mesher::progressive {

/// Models the group of a face, which is usually that of a face beside it.
class GroupCoder {
 public:
  /// `first` and `second` are the groups of two faces beside it; kNone: there is none. `count`: the
  /// number of groups.
  template <class Coder>
  std::uint32_t code(Coder& coder, std::uint32_t first, std::uint32_t second, std::uint32_t group,
                     std::uint32_t count) {
    if (first == kNone) first = second;
    if (second == kNone) second = first;
    if (first != kNone && coder.bit(is_first_[first == second ? 0 : 1], group == first))
      return first;
    if (first != second && coder.bit(is_second_, group == second)) return second;
    return coder.uniform(group, count);
  }

 private:
  AdaptiveBitModel is_first_[2];
  AdaptiveBitModel is_second_;
};

}  // namespace mesher::progressive
