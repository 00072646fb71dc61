#pragma once

#include "app/document/legend.h"
#include "engine/core/image.h"

namespace mesher::app {

/// Draws a legend without a window and without a GPU: straight alpha. `scale`: pixels per point.
/// `most_width`: in pixels. Empty if the legend is empty or does not fit. Call on the main thread
/// while ImGui has a context, because its allocator counts there.
Image legend_image(const Legend& legend, float scale, std::uint32_t most_width,
                   std::uint32_t most_height);

/// Blends an image over rows of a picture, whose first row is number `first_row`. `at`: the place
/// of the image in the picture.
void blend_over(Image& rows, std::uint32_t first_row, const Image& image, const glm::uvec2& at);

}  // namespace mesher::app
