#pragma once

#include <cstdint>

#include "engine/core/image.h"
#include "engine/render/renderer.h"

namespace mesher::render {

/// Draws one picture and fetches it. `mesh` must have been applied with `settings`; alpha is 255.
/// Throws DeviceError.
Image render_image(gpu::Device& device, Renderer& renderer, const GpuMesh& mesh,
                   const Camera& camera, const Settings& settings, std::uint32_t width,
                   std::uint32_t height);

/// Mirrors `mesh`, draws one picture and fetches it: all that a batch run needs.
Image render_image(gpu::Device& device, Mesh& mesh, const Camera& camera, const Settings& settings,
                   std::uint32_t width, std::uint32_t height, const Sources& sources = {});

}  // namespace mesher::render
