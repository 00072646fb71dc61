#include "engine/progressive/codec/range_coder.h"

#include <utility>

namespace mesher::progressive {

void RangeEncoder::carry() {
  // The number written so far is below 1, so a carry never passes the first byte.
  std::size_t i = bytes_.size();
  while (bytes_[--i] == std::byte{0xFF})
    bytes_[i] = std::byte{0};
  bytes_[i] = static_cast<std::byte>(std::to_integer<unsigned>(bytes_[i]) + 1);
}

void RangeEncoder::put(unsigned count) {
  for (unsigned i = 0; i < count; ++i)
    bytes_.push_back(static_cast<std::byte>(low_ >> (56 - 8 * i)));
}

Array<std::byte> RangeEncoder::finish(std::uint64_t least) {
  // The fewest bytes that stay in the interval whatever follows them.
  for (unsigned count = 0; count <= 8; ++count) {
    const std::uint64_t spread = count == 8 ? 0 : ~std::uint64_t{0} >> 8 * count;
    const std::uint64_t distance = ((low_ + spread) & ~spread) - low_;
    if (distance >= range_ || spread >= range_ - distance) continue;
    add(distance);
    put(count);
    break;
  }
  if (plain_count_ > 0) plain_bytes_.push_back(static_cast<std::byte>(plain_));
  const std::size_t size = bytes_.size() + plain_bytes_.size();
  if (size < least) bytes_.resize(least - plain_bytes_.size(), std::byte{0});
  bytes_.insert(bytes_.end(), plain_bytes_.rbegin(), plain_bytes_.rend());
  Array<std::byte> result = std::move(bytes_);
  *this = RangeEncoder();
  return result;
}

}  // namespace mesher::progressive
