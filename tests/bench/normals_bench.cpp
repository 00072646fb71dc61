#include <benchmark/benchmark.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <memory>
#include <string>

#include "engine/mesh/build/build.h"
#include "engine/mesh/normals.h"
#include "tests/bench/models.h"
#include "tests/bench/settings.h"

namespace mesher::bench {
namespace {

using State = benchmark::State;
using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<>;

template <class Run>
void add(const std::string& name, Run run) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](State& state) {
                                 for (auto _ : state)
                                   run();
                               })
      ->Iterations(1)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

std::shared_ptr<OpenMeshMesh> make_openmesh(const Soup& soup) {
  auto mesh = std::make_shared<OpenMeshMesh>();
  for (const glm::vec3& p : soup.positions)
    mesh->add_vertex({p.x, p.y, p.z});
  for (std::size_t c = 0; c < soup.corners.size(); c += 3) {
    const auto corner = [&](std::size_t i) {
      return OpenMesh::VertexHandle(static_cast<int>(soup.corners[c + i]));
    };
    mesh->add_face(corner(0), corner(1), corner(2));
  }
  mesh->request_face_normals();
  mesh->request_vertex_normals();
  return mesh;
}

}  // namespace

void register_normals(const Settings& settings) {
  Soup soup = torus(settings.torus_size);
  const auto peer = make_openmesh(soup);
  const auto ours = std::make_shared<const Mesh>(build_mesh(std::move(soup)).mesh);
  // OpenMesh averages face normals with equal weights to get vertex normals.
  add("normals_vertex/mesher",
      [=] { benchmark::DoNotOptimize(vertex_normals(*ours, NormalWeight::uniform).data()); });
  add("normals_vertex/mesher, by angle",
      [=] { benchmark::DoNotOptimize(vertex_normals(*ours, NormalWeight::angle).data()); });
  add("normals_vertex/OpenMesh", [=] {
    peer->update_face_normals();
    peer->update_vertex_normals();
  });
  add("normals_corner/mesher",
      [=] { benchmark::DoNotOptimize(corner_normals(*ours, {.crease_angle_rad = 0.7F}).data()); });
}

}  // namespace mesher::bench
