// Measures how the time of basic steps grows with the mesh size (docs/efficiency.md).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/core/parallel.h"
#include "engine/mesh/build/build.h"
#include "engine/mesh/collapse.h"
#include "engine/mesh/delta.h"
#include "engine/mesh/normals.h"
#include "engine/simplify/simplify.h"
#include "tests/bench/models.h"
#include "tests/bench/settings.h"

namespace mesher::bench {
namespace {

using State = benchmark::State;

/// Two fans back to back: two vertices of valence n, n of valence 4.
Mesh make_hubs(std::uint32_t n) {
  Soup soup;
  for (std::uint32_t i = 0; i < n; ++i) {
    const float angle =
        2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(n);
    soup.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0F);
    const std::uint32_t next = (i + 1) % n;
    for (const std::uint32_t corner : {i, next, n, next, i, n + 1})
      soup.corners.push_back(corner);
  }
  soup.positions.emplace_back(0.0F, 0.0F, 1.0F);
  soup.positions.emplace_back(0.0F, 0.0F, -1.0F);
  return build_mesh(std::move(soup)).mesh;
}

/// Size n of a grid of 2 n * n triangles with about `faces` triangles.
std::uint32_t grid_size(std::uint32_t faces) {
  return static_cast<std::uint32_t>(std::lround(std::sqrt(faces / 2.0)));
}

Mesh make_grid(std::uint32_t faces) {
  return build_mesh(torus(grid_size(faces))).mesh;
}

/// Adds a benchmark of `run(mesh)` on `make(size)`, on one thread. It repeats the run often enough
/// to be measured, and reports the time of one run. `run` returns the number of items processed.
template <class Make, class Run>
void add(const std::string& task, const std::string& who, std::uint32_t size, Make make, Run run) {
  const auto measure = [=](State& state) {
    const ThreadLimit one(1);
    const Mesh mesh = make(size);
    constexpr std::uint32_t kEnough = 1'000'000;
    const std::uint32_t runs = std::max(kEnough / size, 1U);
    std::size_t items = 0;
    for (auto _ : state) {
      const auto start = std::chrono::steady_clock::now();
      for (std::uint32_t i = 0; i < runs; ++i)
        items = run(mesh);
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
      state.SetIterationTime(elapsed.count() / runs);
    }
    state.counters["items"] = static_cast<double>(items);
  };
  const std::string name = "steps_" + task + "_growth_" + std::to_string(size) + "/" + who;
  benchmark::RegisterBenchmark(name.c_str(), measure)
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

template <NormalWeight kWeight>
std::size_t make_normals(const Mesh& mesh) {
  benchmark::DoNotOptimize(vertex_normals(mesh, kWeight).data());
  return mesh.face_count();
}

std::size_t check_every_halfedge(const Mesh& mesh) {
  std::uint32_t legal = 0;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i)
    legal += check_collapse(mesh, Halfedge(i)).is_legal() ? 1 : 0;
  benchmark::DoNotOptimize(legal);
  return mesh.halfedge_count();
}

/// Checks only some spokes; all of them would take O(n^2 log n).
std::size_t check_some_spokes(const Mesh& mesh) {
  constexpr std::uint32_t kSpokes = 16;
  const std::uint32_t step = mesh.face_count() / kSpokes;
  std::uint32_t legal = 0;
  for (std::uint32_t i = 0; i < kSpokes; ++i)
    legal += check_collapse(mesh, Mesh::halfedge(Face(i * step), 1)).is_legal() ? 1 : 0;
  benchmark::DoNotOptimize(legal);
  return kSpokes;
}

/// Measures undo as in the viewer: finds the difference between a mesh and the mesh without some of
/// its faces, and reverts it. The "peak" is the memory of the difference.
void add_undo(std::uint32_t faces, const std::string& part, double kept) {
  const auto add_step = [=](const std::string& step, bool is_find) {
    const auto measure = [=](State& state) {
      const ThreadLimit one(1);
      const Mesh before = build_mesh(bumpy_torus(grid_size(faces))).mesh;
      const auto target = static_cast<std::uint32_t>(kept * before.face_count());
      const Mesh after =
          simplify::simplify(Mesh(before),
                             {.target_faces = std::min(target, before.face_count() - 1),
                              .order = simplify::ResultOrder::fill_holes})
              .mesh;
      MeshDelta delta = difference(before, after);
      Mesh mesh = before;
      apply(mesh, delta);
      for (auto _ : state) {
        const auto start = std::chrono::steady_clock::now();
        if (is_find) {
          delta = difference(before, after);
        } else {
          revert(mesh, delta);
        }
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        state.SetIterationTime(elapsed.count());
      }
      state.counters["items"] = before.face_count();
      state.counters["peak_bytes_a_face"] =
          static_cast<double>(delta.memory_bytes()) / before.face_count();
    };
    const std::string name =
        "steps_undo_growth_" + std::to_string(faces) + "/" + step + ", " + part;
    benchmark::RegisterBenchmark(name.c_str(), measure)
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  };
  add_step("difference", true);
  add_step("revert", false);
}

}  // namespace

void register_steps(const Settings& settings) {
  for (std::uint32_t faces = 10'000; faces <= settings.growth_faces; faces *= 10) {
    add("gouraud", "uniform", faces, make_grid, make_normals<NormalWeight::uniform>);
    add("gouraud", "by angle", faces, make_grid, make_normals<NormalWeight::angle>);
  }
  for (std::uint32_t faces = 10'000; faces <= std::min(settings.growth_faces, 1'000'000U);
       faces *= 10)
    add("legality", "every half-edge, valence 6", faces, make_grid, check_every_halfedge);
  for (std::uint32_t spokes = 1'000; spokes <= 100'000; spokes *= 10)
    add("legality_hub", "a spoke of n", spokes, make_hubs, check_some_spokes);
  for (std::uint32_t faces = 10'000; faces <= std::min(settings.growth_faces, 1'000'000U);
       faces *= 10) {
    add_undo(faces, "a tenth removed", 0.9);
    add_undo(faces, "one edge removed", 1.0);
  }
}

}  // namespace mesher::bench
