#include "app/level_errors.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "engine/mesh/packed_normal.h"

namespace mesher::app {
namespace {

constexpr double kCoarserBelow = 0.8;
constexpr double kNearestRadii = 0.1;

float moved_off(const glm::vec3& delta, const SplitMorph& split) {
  float most = 0.0F;
  for (const std::uint32_t normal : {split.coarse_normal, split.parent_normal, split.child_normal})
    most = std::max(most, std::abs(glm::dot(delta, decode_normal(normal))));
  return most;
}

/// Whether one face opens instead of two.
bool is_at_boundary(const ProgressiveMesh& mesh, std::uint32_t split) {
  return mesh.face_count(split + 1) == mesh.face_count(split) + 1;
}

float error_of(const ProgressiveMesh& mesh, const SplitMorph& split, std::uint32_t i) {
  if (is_at_boundary(mesh, i)) {
    return std::max(glm::length(split.parent_delta), glm::length(split.child_delta));
  }
  return std::max(moved_off(split.parent_delta, split), moved_off(split.child_delta, split));
}

}  // namespace

LevelErrors::LevelErrors(const ProgressiveMesh& mesh, const Geomorph& geomorph) {
  errors_.resize(mesh.split_count());
  float most = 0.0F;
  for (std::uint32_t i = mesh.split_count(); i-- > 0;) {
    most = std::max(most, error_of(mesh, geomorph.splits()[i], i));
    errors_[i] = most;
  }
}

double LevelErrors::error(std::uint32_t level) const {
  return level < errors_.size() ? errors_[level] : 0.0;
}

std::uint32_t LevelErrors::level_within(double error) const {
  const auto first = std::partition_point(errors_.begin(), errors_.end(),
                                          [&](float e) { return double(e) > error; });
  return static_cast<std::uint32_t>(first - errors_.begin());
}

std::uint32_t automatic_level(const LevelErrors& errors, std::uint32_t level, double tolerance,
                              double pixels_a_unit) {
  const double allowed = tolerance / pixels_a_unit;
  const std::uint32_t finer = errors.level_within(allowed);
  if (finer >= level) return finer;
  return std::min(level, errors.level_within(kCoarserBelow * allowed));
}

double pixels_a_unit(const render::Camera& camera, const Box& box, const glm::dvec2& window) {
  const render::WindowPlaces places = camera.places(window);
  if (!places.perspective) return places.scale;
  const double radius = std::max(0.5 * box.diagonal(), 1e-30);
  const glm::dvec3 middle = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
  const double distance = glm::distance(camera.eye(), middle) - radius;
  return places.scale / std::max(distance, kNearestRadii * radius);
}

}  // namespace mesher::app
