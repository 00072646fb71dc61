#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "engine/gpu/device.h"
#include "engine/gpu/instance.h"
#include "engine/mesh/build.h"
#include "engine/mesh/statistics.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/renderer.h"
#include "engine/render/scene_target.h"
#include "tests/bench/models.h"
#include "tests/bench/settings.h"

namespace mesher::bench {
namespace {

using State = benchmark::State;

constexpr std::uint32_t kPixels = 500;

/// A device, and a mesh on it with everything a frame needs. Kept until the program ends.
struct Scene {
  explicit Scene(std::uint32_t torus_size) : mesh(build_mesh(torus(torus_size)).mesh) {
    camera.set_angles(0.6, 0.5);
    camera.frame(bounding_box(mesh), 1.0);
  }

  gpu::Instance instance;
  gpu::Device device{instance};
  Mesh mesh;
  render::Camera camera;
  render::GpuMesh gpu_mesh{device};
  render::Renderer renderer{device};
  render::SceneTarget target{device, {kPixels, kPixels}, render::Settings{}.samples};
};

using Draw = void (render::Renderer::*)(VkCommandBuffer, const render::SceneTarget&,
                                        const render::GpuMesh&, const render::Camera&,
                                        const render::Settings&);

/// Records, submits and waits for whole frames.
void draw_frames(State& state, Scene& scene, const render::Settings& settings, Draw draw) {
  scene.gpu_mesh.apply(scene.mesh, settings);
  const auto frame = [&] {
    scene.device.run_once([&](VkCommandBuffer commands) {
      (scene.renderer.*draw)(commands, scene.target, scene.gpu_mesh, scene.camera, settings);
    });
  };
  frame();  // makes the pipeline
  for (auto _ : state)
    frame();
}

void add(const std::string& name, const std::shared_ptr<Scene>& scene,
         const render::Settings& settings, Draw draw) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](State& state) { draw_frames(state, *scene, settings, draw); })
      ->Iterations(5)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_frame(const Settings& settings) {
  const auto scene = std::make_shared<Scene>(settings.frame_torus_size);
  const auto add_pair = [&](const std::string& task, const render::Settings& look) {
    add(task + "/mesher", scene, look, &render::Renderer::draw);
    add(task + "/bare indexed draw", scene, look, &render::Renderer::draw_bare);
  };
  add_pair("frame_flat", {.shading = render::Shading::flat});
  add_pair("frame_gouraud", {.shading = render::Shading::gouraud});
  add_pair("frame_wireframe", {.shading = render::Shading::gouraud, .wireframe = true});
}

}  // namespace mesher::bench
