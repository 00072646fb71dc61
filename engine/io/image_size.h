#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string_view>

namespace mesher::io {

/// Returns width and height of an encoded image by its header: PNG, JPEG, WebP, KTX2 or DDS, which
/// the bytes tell apart. Nothing if the header is damaged or of another kind. Decodes no pixels.
std::optional<glm::uvec2> image_size(std::string_view bytes);

}  // namespace mesher::io
