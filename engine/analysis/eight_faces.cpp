#include "engine/analysis/eight_faces.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace mesher::analysis {
namespace {

// Bounds the rounding of a distance from a plane through a corner, in relation to the lengths of
// two sides and the distance from that corner. The true factor is below 8 units of 2^-24.
constexpr float kRoundingOfDistance = 2e-6F;
// Covers products that underflow: those of a distance, and those of a normal.
constexpr float kUnderflow = 1e-30F;
constexpr float kUnderflowOfNormal = 1e-43F;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
float taxicab(const glm::vec3& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

Float4 taxicab(const Vec3<Float4>& v) {
  return greater_of(v.x, -v.x) + greater_of(v.y, -v.y) + greater_of(v.z, -v.z);
}

/// Whether points are certainly above or below a plane.
struct SideOfPlane {
  Int4 above = kAlways;
  Int4 below = kAlways;

  /// Adds points at these distances. Products that overflow leave the side uncertain.
  void add(Float4 distance, Float4 doubt) {
    above &= (distance > doubt) & (distance < broadcast<Float4>(kInfinity));
    below &= (distance < -doubt) & (distance > broadcast<Float4>(-kInfinity));
  }
};

}  // namespace

void EightFaces::clear() {
  boxes_.clear();
  for (std::size_t lane = 0; lane < kFaces; ++lane) {
    for (std::size_t c = 0; c < 3; ++c) {
      corners_[c].set(lane, glm::vec3(0.0F));
      graphs_[c][lane] = kNone;
    }
    normals_.set(lane, glm::vec3(0.0F));
    doubts_[lane] = 0.0F;
  }
}

void EightFaces::set(std::size_t lane, const Mesh& mesh, Face f,
                     std::span<const std::uint8_t> is_graph) {
  std::array<glm::vec3, 3> p;
  for (std::uint32_t c = 0; c < 3; ++c) {
    const Vertex v = mesh.origin(Mesh::halfedge(f, c));
    p[c] = mesh.position(v);
    corners_[c].set(lane, p[c]);
    graphs_[c][lane] = is_graph[v.index()] != 0 ? v.index() : kNone;
  }
  boxes_.set(lane, {glm::min(glm::min(p[0], p[1]), p[2]), glm::max(glm::max(p[0], p[1]), p[2])});
  normals_.set(lane, glm::cross(p[1] - p[0], p[2] - p[0]));
  doubts_[lane] =
      kRoundingOfDistance * taxicab(p[1] - p[0]) * taxicab(p[2] - p[0]) + kUnderflowOfNormal;
}

ExactTriangle EightFaces::triangle(std::size_t lane) const {
  return {corners_[0].get(lane), corners_[1].get(lane), corners_[2].get(lane)};
}

std::uint32_t EightFaces::may_intersect(const EightFaces& other, std::size_t lane) const {
  std::uint32_t bits = boxes_.overlapping(other.boxes_.get(lane));
  for (std::size_t first = 0; first < kFaces; first += 4) {
    const auto left = [&] { return (bits >> first & 0xFU) != 0; };
    if (left()) bits &= ~(bits_of(share_graph(first, other, lane)) << first);
    if (left()) bits &= ~(bits_of(is_one_sided(first, other, lane)) << first);
  }
  return bits;
}

/// Returns in which of four lanes the face shares a vertex with the other face whose faces form a
/// graph.
Int4 EightFaces::share_graph(std::size_t first, const EightFaces& other, std::size_t lane) const {
  Int4 shares{};
  for (const auto& theirs : other.graphs_) {
    const auto id = static_cast<std::int32_t>(theirs[lane]);
    for (const auto& ours : graphs_) {
      Int4 ids;
      std::memcpy(&ids, &ours[first], sizeof ids);
      shares |= (ids == Int4{} + id) & (ids != Int4{} + static_cast<std::int32_t>(kNone));
    }
  }
  return shares;
}

/// Returns in which of four lanes the face is on one side of the other's plane, or the other way
/// around, whatever the rounding.
Int4 EightFaces::is_one_sided(std::size_t first, const EightFaces& other, std::size_t lane) const {
  const Vec3<Float4> their_normal = in_four_lanes(other.normals_.get(lane));
  const Vec3<Float4> their_base = in_four_lanes(other.corners_[0].get(lane));
  const Float4 their_doubt = broadcast<Float4>(other.doubts_[lane]);
  const Vec3<Float4> normals = normals_.load(first);
  const Vec3<Float4> bases = corners_[0].load(first);
  const Float4 doubts = load4(&doubts_[first]);
  SideOfPlane ours;
  SideOfPlane theirs;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3<Float4> our_corner = corners_[c].load(first) - their_base;
    ours.add(dot(their_normal, our_corner), their_doubt * taxicab(our_corner) + kUnderflow);
    const Vec3<Float4> their_corner = in_four_lanes(other.corners_[c].get(lane)) - bases;
    theirs.add(dot(normals, their_corner), doubts * taxicab(their_corner) + kUnderflow);
  }
  return ours.above | ours.below | theirs.above | theirs.below;
}

}  // namespace mesher::analysis
