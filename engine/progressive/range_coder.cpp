#include "engine/progressive/range_coder.h"

#include <utility>

namespace mesher {

void RangeEncoder::carry() {
  // The number written so far is below 1, so that a carry ends before the first byte.
  std::size_t i = bytes_.size();
  while (bytes_[--i] == std::byte{0xFF})
    bytes_[i] = std::byte{0};
  bytes_[i] = static_cast<std::byte>(std::to_integer<unsigned>(bytes_[i]) + 1);
}

void RangeEncoder::put(unsigned count) {
  for (unsigned i = 0; i < count; ++i)
    bytes_.push_back(static_cast<std::byte>(low_ >> (56 - 8 * i)));
}

Array<std::byte> RangeEncoder::finish() {
  // The number of the fewest bytes that lies in the interval.
  for (unsigned count = 0; count <= 8; ++count) {
    const std::uint64_t rest = count == 0   ? ~std::uint64_t{0}
                               : count == 8 ? 0
                                            : (std::uint64_t{1} << (64 - 8 * count)) - 1;
    const std::uint64_t distance = ((low_ + rest) & ~rest) - low_;
    if (distance >= range_) continue;
    add(distance);
    put(count);
    break;
  }
  while (!bytes_.empty() && bytes_.back() == std::byte{0})
    bytes_.pop_back();
  low_ = 0;
  range_ = ~std::uint64_t{0};
  return std::exchange(bytes_, {});
}

}  // namespace mesher
