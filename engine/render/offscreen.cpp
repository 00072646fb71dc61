#include "engine/render/offscreen.h"

namespace mesher::render {

Image render_image(gpu::Device& device, Renderer& renderer, const GpuMesh& mesh,
                   const Camera& camera, const Settings& settings, std::uint32_t width,
                   std::uint32_t height) {
  const SceneTarget target(device, {width, height}, settings.samples);
  device.run_once(
      [&](VkCommandBuffer commands) { renderer.draw(commands, target, mesh, camera, settings); });
  return gpu::read_image(device, target.color(), gpu::kTransferSource);
}

Image render_image(gpu::Device& device, Mesh& mesh, const Camera& camera, const Settings& settings,
                   std::uint32_t width, std::uint32_t height, const Sources& sources) {
  GpuMesh gpu_mesh(device);
  gpu_mesh.apply(mesh, settings, sources);
  Renderer renderer(device);
  return render_image(device, renderer, gpu_mesh, camera, settings, width, height);
}

}  // namespace mesher::render
