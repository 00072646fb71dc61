#include "engine/progressive/level_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/analysis/triangle_tree.h"
#include "engine/mesh/circulators.h"

namespace mesher::progressive {
namespace {

/// Times of refining to full detail, measuring, and returning.
constexpr double kErrorWeights[] = {0.04, 0.92, 0.04};

/// Squared, to the faces around a vertex.
double squared_distance_to(const Mesh& mesh, Vertex v, const glm::vec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Face f : faces_around(mesh, v)) {
    const auto corner = [&](std::uint32_t i) {
      return glm::dvec3(mesh.position(mesh.origin(Mesh::halfedge(f, i))));
    };
    least = std::min(least, analysis::squared_distance(point, {corner(0), corner(1), corner(2)}));
  }
  return least;
}

/// How far the surface moves in the step down from level `i + 1`, to which the mesh is brought.
double step_down(ProgressiveMesh& mesh, std::uint32_t i) {
  const VertexSplit& split = mesh.splits()[i];
  const double before =
      std::min(squared_distance_to(mesh.mesh(), split.parent, split.coarse_position),
               squared_distance_to(mesh.mesh(), mesh.child(i), split.coarse_position));
  mesh.go_to(i);
  return std::sqrt(
      std::max({before, squared_distance_to(mesh.mesh(), split.parent, split.fine_position),
                squared_distance_to(mesh.mesh(), split.parent, split.child_position)}));
}

}  // namespace

LevelErrors::LevelErrors(ProgressiveMesh& mesh, Progress* progress) {
  constexpr std::uint32_t kBetweenReports = 4096;
  const std::uint32_t level = mesh.level();
  const std::uint32_t splits = mesh.split_count();
  Stages stages(progress, kErrorWeights);
  stages.next();
  errors_.resize(splits);
  go_to_level(mesh, splits, progress);
  stages.next();
  double most = 0.0;
  for (std::uint32_t i = splits; i-- > 0;) {
    if (i % kBetweenReports == 0) report(progress, 1.0F - float(i) / float(splits));
    most = std::max(most, step_down(mesh, i));
    errors_[i] = static_cast<float>(most);
  }
  stages.next();
  go_to_level(mesh, level, progress);
}

double LevelErrors::error(std::uint32_t level) const {
  return level < errors_.size() ? errors_[level] : 0.0;
}

std::uint32_t LevelErrors::level_within(double error) const {
  const auto first = std::partition_point(errors_.begin(), errors_.end(),
                                          [&](float e) { return double(e) > error; });
  return static_cast<std::uint32_t>(first - errors_.begin());
}

}  // namespace mesher::progressive
