#include "engine/analysis/fan_graph.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"

namespace mesher::analysis {
namespace {

bool is_graph(const Mesh& mesh, Vertex v) {
  // Least part of the mean normal that each normal must have. Far above the rounding of doubles.
  constexpr double kLeastFacing = 1e-6;
  // If the normals nearly cancel, their mean is uncertain.
  constexpr double kLeastMean = 1e-8;
  constexpr std::size_t kMostFaces = 32;
  std::array<glm::dvec3, kMostFaces + 1> spokes;
  std::array<glm::dvec3, kMostFaces> normals;
  if (mesh.is_isolated(v)) return false;
  const glm::dvec3 center(mesh.position(v));
  Circulator at(mesh, mesh.outgoing(v));
  // A removed face has no corners.
  if (mesh.origin(*at) != v) return false;
  spokes[0] = glm::dvec3(mesh.position(mesh.target(*at))) - center;
  std::size_t count = 0;
  glm::dvec3 mean(0.0);
  double squares = 0.0;
  do {
    if (count == kMostFaces || mesh.origin(*at) != v) return false;
    const glm::dvec3 next = glm::dvec3(mesh.position(mesh.origin(Mesh::prev(*at)))) - center;
    spokes[count + 1] = next;
    normals[count] = glm::cross(spokes[count], next);
    squares += glm::dot(normals[count], normals[count]);
    mean += normals[count++];
  } while (at.advance());
  if (!(glm::dot(mean, mean) > kLeastMean * squares)) return false;
  const double least = kLeastFacing * glm::dot(mean, mean) / static_cast<double>(count);
  // Seen along the mean normal, the spokes turn counterclockwise. They cross this half-plane from
  // below once per revolution.
  const glm::dvec3 up = std::abs(mean.x) < std::abs(mean.y) ? glm::cross(glm::dvec3(1, 0, 0), mean)
                                                            : glm::cross(glm::dvec3(0, 1, 0), mean);
  std::size_t rounds = 0;
  double height = glm::dot(up, spokes[0]);
  for (std::size_t i = 0; i < count; ++i) {
    if (!(glm::dot(normals[i], mean) > least)) return false;
    const double next = glm::dot(up, spokes[i + 1]);
    rounds += static_cast<std::size_t>(height < 0.0 && next >= 0.0);
    height = next;
  }
  return rounds <= (at.is_closed() ? 1U : 0U);
}

}  // namespace

Array<std::uint8_t> find_graphs(const Mesh& mesh) {
  constexpr std::size_t kGrain = 4096;
  Array<std::uint8_t> found(mesh.vertex_count());
  parallel_for_each(mesh.vertex_count(), kGrain,
                    [&](std::uint32_t i) { found[i] = is_graph(mesh, Vertex(i)) ? 1 : 0; });
  return found;
}

}  // namespace mesher::analysis
