#pragma once

#include <cstdint>

#include "engine/core/image.h"
#include "engine/render/renderer.h"

namespace mesher::render {

/// Draws one image and returns it, with alpha 255. Pre: `mesh` has been applied with `settings`.
/// Throws DeviceError.
Image render_image(gpu::Device& device, Renderer& renderer, const GpuMesh& mesh,
                   const Camera& camera, const Settings& settings, std::uint32_t width,
                   std::uint32_t height);

/// Mirrors `mesh`, draws one image and returns it. Batch runs need nothing else.
Image render_image(gpu::Device& device, Mesh& mesh, const Camera& camera, const Settings& settings,
                   std::uint32_t width, std::uint32_t height, const Sources& sources = {});

}  // namespace mesher::render
