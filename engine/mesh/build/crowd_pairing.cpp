#include "engine/mesh/build/crowd_pairing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace mesher {

void CrowdPairing::run(std::span<const std::uint32_t> crowd) {
  sort_by_angle(crowd);
  const Vertex low = std::min(origin(crowd[0]), target(crowd[0]));
  open_.clear();
  for (int round = 0; round < 2; ++round) {
    for (const auto& [angle, h] : by_angle_) {
      if (mesh_.twin[h].is_valid()) continue;
      const bool runs_up = origin(h) == low;
      if (!runs_up && round == 0) open_.push_back(h);
      if (!runs_up || open_.empty()) continue;
      mesh_.twin[h] = Halfedge(open_.back());
      mesh_.twin[open_.back()] = Halfedge(h);
      open_.pop_back();
    }
  }
}

void CrowdPairing::sort_by_angle(std::span<const std::uint32_t> crowd) {
  const auto [low, high] = std::minmax({origin(crowd[0]), target(crowd[0])});
  const glm::dvec3 base = mesh_.position[low.index()];
  const glm::dvec3 axis = glm::dvec3(mesh_.position[high.index()]) - base;
  const glm::dvec3 aside =
      std::abs(axis.x) <= std::abs(axis.y) && std::abs(axis.x) <= std::abs(axis.z)
          ? glm::dvec3(1, 0, 0)
      : std::abs(axis.y) <= std::abs(axis.z) ? glm::dvec3(0, 1, 0)
                                             : glm::dvec3(0, 0, 1);
  const glm::dvec3 u = glm::cross(axis, aside);
  const glm::dvec3 v = glm::cross(axis, u) / std::max(glm::length(axis), 1e-300);
  by_angle_.clear();
  for (const std::uint32_t h : crowd) {
    const Vertex apex = mesh_.origin[Mesh::prev(Halfedge(h)).index()];
    const glm::dvec3 d = glm::dvec3(mesh_.position[apex.index()]) - base;
    by_angle_.emplace_back(std::atan2(glm::dot(d, v), glm::dot(d, u)), h);
  }
  std::sort(by_angle_.begin(), by_angle_.end());
}

}  // namespace mesher
