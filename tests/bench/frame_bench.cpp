#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "engine/gpu/device.h"
#include "engine/gpu/instance.h"
#include "engine/io/read.h"
#include "engine/mesh/build/build.h"
#include "engine/mesh/statistics.h"
#include "engine/progressive/build.h"
#include "engine/progressive/geomorph.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/renderer.h"
#include "engine/render/scene_target.h"
#include "tests/bench/models.h"
#include "tests/bench/settings.h"

namespace mesher::bench {
namespace {

using State = benchmark::State;

constexpr std::uint32_t kPixels = 500;

/// A device and a mesh on it with everything that a frame needs. It lives until the program ends.
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
  frame();  // creates the pipeline
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

/// A progressive mesh that is controlled by a slider.
struct DragScene {
  explicit DragScene(const Mesh& full)
      : mesh(progressive::make_progressive(full, {.target_faces = full.face_count() / 100}).mesh),
        geomorph(mesh) {
    camera.set_angles(0.6, 0.3);
    camera.frame(bounding_box(full), 1.0);
  }

  /// Draws the frame for a slider position from 0 to 1 and waits for it. Returns the number of
  /// bytes copied to the GPU.
  std::uint64_t show(double position, render::Settings settings,
                     const render::SceneTarget& target) {
    // As in the viewer, an eighth of the current vertices are in the geomorph range.
    const double count = mesh.split_count();
    const double base = mesh.base_vertex_count();
    const double time = position * (count - 1.0 + kGrowing * base) / (1.0 - kGrowing);
    const double range = std::max(1.0, kGrowing * (base + time));
    mesh.go_to(static_cast<std::uint32_t>(std::min(count, std::ceil(time))));
    geomorph.follow(mesh);
    settings.geomorph = GeomorphTime::continuous(time, range);
    const render::UploadStats stats =
        gpu_mesh.apply(mesh.mesh(), settings,
                       {.vertex_normals = geomorph.normals(),
                        .morph = {.heads = geomorph.heads(), .splits = geomorph.splits()}});
    device.run_once([&](VkCommandBuffer commands) {
      renderer.draw(commands, target, gpu_mesh, camera, settings);
    });
    return stats.uploaded_bytes;
  }

  static constexpr double kGrowing = 0.125;
  gpu::Instance instance;
  gpu::Device device{instance};
  progressive::ProgressiveMesh mesh;
  progressive::Geomorph geomorph;
  render::Camera camera;
  render::GpuMesh gpu_mesh{device};
  render::Renderer renderer{device};
};

/// Moves the slider from end to end and back, a hundred frames in each direction.
void drag(State& state, DragScene& scene, const render::Settings& settings) {
  using Clock = std::chrono::steady_clock;
  constexpr int kFrames = 100;
  const render::SceneTarget target(scene.device, {kPixels, kPixels}, settings.samples);
  scene.show(0.5, settings, target);  // creates the pipelines
  scene.show(1.0, settings, target);
  for (auto _ : state) {
    double bytes = 0.0;
    double longest = 0.0;
    const auto start = Clock::now();
    for (int i = 1; i <= 2 * kFrames; ++i) {
      const auto begin = Clock::now();
      const double position = std::abs(1.0 - static_cast<double>(i) / kFrames);
      bytes += static_cast<double>(scene.show(position, settings, target));
      longest = std::max(longest, std::chrono::duration<double>(Clock::now() - begin).count());
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    state.SetIterationTime(seconds / (2 * kFrames));
    state.counters["frames_per_s"] = 2 * kFrames / seconds;
    state.counters["longest_ms"] = 1e3 * longest;
    state.counters["kb_a_frame"] = 1e-3 * bytes / (2 * kFrames);
  }
}

void register_drag(const Settings& settings) {
  const std::filesystem::path file = settings.scans / "armadillo.obj";
  if (!std::filesystem::exists(file)) {
    std::fprintf(stderr, "bench_engine: SKIPPED frame_drag: no %s\n", file.string().c_str());
    return;
  }
  const auto scene = std::make_shared<DragScene>(io::read_model(file, {}).mesh);
  const auto add_drag = [&](const std::string& task, const render::Settings& look) {
    benchmark::RegisterBenchmark((task + "/mesher").c_str(),
                                 [=](State& state) { drag(state, *scene, look); })
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  };
  add_drag("frame_drag", {.shading = render::Shading::flat});
  add_drag("frame_drag_1_sample", {.shading = render::Shading::flat, .samples = 1});
  add_drag("frame_drag_gouraud", {.shading = render::Shading::gouraud});
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
  register_drag(settings);
}

}  // namespace mesher::bench
