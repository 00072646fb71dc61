#pragma once

#include <cstdint>
#include <string>

#include "engine/core/image.h"
#include "engine/gpu/device.h"

namespace mesher::test {

/// How two pictures of one size differ.
struct Difference {
  double mean = 0.0;           ///< of all components, 0 to 255
  double share_visible = 0.0;  ///< of pixels that differ by more than a tenth somewhere
  std::uint64_t pixels = 0;    ///< that differ at all
  int largest = 0;             ///< of one component
  Image picture;               ///< what differs, four times as strong
};

/// Pre: of one size.
Difference difference_of(const Image& a, const Image& b);

/// How much a picture may differ from its golden: where driver, vector width and the processor's
/// approximate reciprocals are those of tests/golden/driver.txt, not at all; on the same driver
/// elsewhere no component by more than a few steps of 255; on another driver a little rounding.
enum class Agreement : std::uint8_t { exact, same_driver, other_driver };

bool agrees(const Difference& difference, Agreement expected);

/// Fails where `image`, drawn by `device`, is not what tests/golden/NAME.png shows, and leaves it
/// in the build's golden_candidates. A picture without a golden fails, too: a person looks at the
/// candidate first.
void expect_golden(const gpu::Device& device, const std::string& name, const Image& image);

}  // namespace mesher::test
