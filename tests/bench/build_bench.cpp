#include <benchmark/benchmark.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <chrono>
#include <memory>
#include <string>

#include "engine/core/parallel.h"
#include "engine/mesh/build/build.h"
#include "tests/bench/memory.h"
#include "tests/bench/models.h"
#include "tests/bench/settings.h"

namespace mesher::bench {
namespace {

using State = benchmark::State;
using SharedSoup = std::shared_ptr<const Soup>;

/// Runs `build`, which takes arrays and returns {faces, bytes that the mesh holds}, and records
/// time, size and peak memory. The peak includes the mesh and all temporary memory, but not the
/// input.
template <class Build>
void measure(State& state, const Soup& soup, Build build) {
  const double faces = soup.face_count();
  for (auto _ : state) {
    Soup input = soup;
    const PeakMemory peak;
    const auto start = std::chrono::steady_clock::now();
    const auto mesh = build(std::move(input));
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    state.SetIterationTime(elapsed.count());
    state.counters["peak_bytes_a_face"] = static_cast<double>(peak.rise_bytes()) / faces;
    if (mesh->face_count() != soup.face_count()) state.SkipWithError("lost faces");
    state.counters["bytes_a_face"] = static_cast<double>(mesh->memory_bytes()) / faces;
  }
}

struct OurMesh {
  BuildResult result;
  std::size_t face_count() const { return result.mesh.face_count(); }
  std::size_t memory_bytes() const { return result.mesh.memory_bytes(); }
};

struct OpenMeshMesh {
  OpenMesh::TriMesh_ArrayKernelT<> mesh;
  std::size_t face_count() const { return mesh.n_faces(); }
  /// Bytes of its kernel and its standard properties: per edge two half-edges of four handles, per
  /// face and per vertex one handle, and per vertex a point of three floats.
  std::size_t memory_bytes() const {
    return mesh.n_edges() * 2 * 16 + mesh.n_faces() * 4 + mesh.n_vertices() * (4 + 12);
  }
};

void build_ours(State& state, const SharedSoup& soup) {
  measure(state, *soup, [](Soup&& input) {
    return std::make_unique<OurMesh>(OurMesh{build_mesh(std::move(input))});
  });
}

void build_ours_one_thread(State& state, const SharedSoup& soup) {
  const ThreadLimit one(1);
  build_ours(state, soup);
}

void build_openmesh(State& state, const SharedSoup& soup) {
  measure(state, *soup, [](Soup&& input) {
    auto result = std::make_unique<OpenMeshMesh>();
    auto& mesh = result->mesh;
    mesh.reserve(input.positions.size(), input.corners.size() / 2, input.face_count());
    for (const glm::vec3& p : input.positions)
      mesh.add_vertex({p.x, p.y, p.z});
    for (std::size_t c = 0; c < input.corners.size(); c += 3) {
      const auto corner = [&](std::size_t i) {
        return OpenMesh::VertexHandle(static_cast<int>(input.corners[c + i]));
      };
      mesh.add_face(corner(0), corner(1), corner(2));
    }
    return result;
  });
}

template <class Build>
void add(const std::string& name, Build build, const SharedSoup& soup) {
  benchmark::RegisterBenchmark(name.c_str(), [=](State& state) { build(state, soup); })
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_build(const Settings& settings) {
  const auto ordered = std::make_shared<const Soup>(torus(settings.torus_size));
  const auto random = std::make_shared<const Soup>(shuffled(*ordered));
  add("build/mesher", build_ours, ordered);
  add("build/mesher, one thread", build_ours_one_thread, ordered);
  add("build/OpenMesh", build_openmesh, ordered);
  add("build_shuffled/mesher", build_ours, random);
  add("build_shuffled/mesher, one thread", build_ours_one_thread, random);
  add("build_shuffled/OpenMesh", build_openmesh, random);
}

}  // namespace mesher::bench
