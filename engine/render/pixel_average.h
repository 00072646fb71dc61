#pragma once

#include "engine/core/image.h"

namespace mesher::render {

/// Returns an image of the averages of n x n pixels, in linear light.
///
/// `drawn` is as the renderer leaves it: sRGB-encoded, premultiplied in linear light. The result
/// has straight alpha, as PNG and WebP require: a pixel that is half covered has half the alpha and
/// the color of what covers it, so that no background shows through. Where alpha is 0, so is the
/// color. Pre: both sides of `drawn` are multiples of n, which is at least 1. O(pixels).
Image average_pixels(const Image& drawn, unsigned n);

}  // namespace mesher::render
