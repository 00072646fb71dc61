#include "tests/bench/contenders.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>

#include "engine/core/parallel.h"
#include "engine/mesh/build/build.h"
#include "engine/simplify/simplify.h"

namespace mesher::bench {

Soup simplify_ours(Soup&& soup, std::uint32_t target_faces) {
  simplify::CollapseRecorder recorder;
  simplify::Simplified simplified = simplify::simplify(
      build_mesh(std::move(soup)).mesh, {.target_faces = target_faces, .observer = &recorder});
  MeshArrays arrays = MeshArrays::take(std::move(simplified.mesh));
  Soup result;
  result.positions = std::move(arrays.position);
  result.corners.resize(arrays.origin.size());
  std::ranges::transform(arrays.origin, result.corners.begin(), &Vertex::index);
  return result;
}

Soup simplify_ours_one_thread(Soup&& soup, std::uint32_t target_faces) {
  const ThreadLimit one(1);
  return simplify_ours(std::move(soup), target_faces);
}

Soup simplify_meshoptimizer(Soup&& soup, std::uint32_t target_faces) {
  constexpr float kAnyError = 1e10F;
  const std::size_t vertices = soup.positions.size();
  Soup result;
  result.corners.resize(soup.corners.size());
  result.corners.resize(meshopt_simplify(
      result.corners.data(), soup.corners.data(), soup.corners.size(), &soup.positions.data()->x,
      vertices, sizeof(glm::vec3), 3 * std::size_t{target_faces}, kAnyError, 0, nullptr));
  result.positions.resize(vertices);
  result.positions.resize(meshopt_optimizeVertexFetch(
      result.positions.data(), result.corners.data(), result.corners.size(), soup.positions.data(),
      vertices, sizeof(glm::vec3)));
  return result;
}

std::span<const Contender> contenders() {
  static constexpr std::array<Contender, 6> all{{
      {"mesher", simplify_ours},
      {"mesher, one thread", simplify_ours_one_thread},
      {"meshoptimizer", simplify_meshoptimizer},
      {"OpenMesh", simplify_openmesh, true},
      {"CGAL Lindstrom-Turk", simplify_cgal_lindstrom_turk, true},
      {"CGAL Garland-Heckbert", simplify_cgal_garland_heckbert, true},
  }};
  return all;
}

}  // namespace mesher::bench
