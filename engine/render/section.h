#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>

namespace mesher::render {

/// The part of a picture that one target holds.
struct PicturePart {
  VkExtent2D picture;       ///< size of the whole picture, in pixels; at most 65,535 per side
  VkOffset2D corner{0, 0};  ///< of the part
  /// Pixels of the picture per pixel of the window, 1 to 255. Widths of lines and all other lengths
  /// that are pixels in the window grow by it.
  unsigned pixel_ratio = 1;
  bool is_transparent = false;  ///< alpha 0 instead of the background; color is premultiplied
  /// The largest side of a viewport. The device's own limit is respected as well.
  std::uint32_t largest_viewport = 0xFFFFFFFFU;
};

/// The viewport to draw a part of a picture with, and the section of the view that it shows.
///
/// The viewport reaches over the whole picture, beyond the target, so every part projects a vertex
/// with the same arithmetic. The positions of two parts differ by whole pixels, up to the rounding
/// of one addition. A picture that is larger than the device's largest viewport is divided into
/// overlapping sections of a power of two per side. The vertex shader enlarges the section by that
/// power (`to_section` in shaders/view.glsl), which rounds once more.
struct Section {
  VkViewport viewport{};
  /// For the vertex shaders, as the index of the instance, because the push constants are full:
  /// log2 of the factor for x and y (4 bits each), and the center of the section for x and y (8
  /// bits each, signed) in units of half a section. 0: the whole view.
  std::uint32_t code = 0;
};

/// Returns the section for a target of `size` pixels at the corner of `part`, on a device with
/// viewports up to `device_limit`. Pre: its sides are at most a quarter of the largest viewport
/// where the picture is larger than that.
Section section_of(const PicturePart& part, VkExtent2D size, VkExtent2D device_limit);

}  // namespace mesher::render
