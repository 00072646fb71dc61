#pragma once

#include <cstdint>
#include <string>

#include "engine/core/image.h"
#include "engine/gpu/device.h"

namespace mesher::test {

/// The difference between two pictures of one size.
struct Difference {
  double mean = 0.0;           ///< of all components, 0 to 255
  double share_visible = 0.0;  ///< of pixels with a component that differs by more than a tenth
  std::uint64_t pixels = 0;    ///< number of pixels that differ
  int largest = 0;             ///< of one component
  Image picture;               ///< the difference, multiplied by four
};

/// Pre: both have one size.
Difference difference_of(const Image& a, const Image& b);

/// How much a picture may differ from its golden. `exact`: not at all; driver, vector width and
/// processor are those of tests/golden/driver.txt. `same_driver`: no
/// component by more than a few steps of 255. `other_driver`: by a little rounding.
enum class Agreement : std::uint8_t { exact, same_driver, other_driver };

bool agrees(const Difference& difference, Agreement expected);

/// Fails if `image`, drawn by `device`, differs from tests/golden/NAME.png, and writes it to the
/// build's golden_candidates. A picture without a golden also fails, so that a person looks at the
/// candidate first.
void expect_golden(const gpu::Device& device, const std::string& name, const Image& image);

}  // namespace mesher::test
