#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>

#include "engine/core/lanes.h"
#include "engine/mesh/mesh.h"
#include "engine/simplify/quadric.h"

namespace mesher::simplify {

/// How a vertex may move.
enum class VertexConstraint : std::uint8_t {
  free,  ///< anywhere: it has no feature edge
  line,  ///< along its two feature edges
  /// Fixed: it has one, three or more feature edges, a sharpness of its own, is a copy of a bow-tie
  /// vertex, or is locked.
  corner,
};

/// Where the merged vertex of an edge may be placed.
enum class AllowedPlacement : std::uint8_t {
  anywhere,
  at_origin,
  at_target,
  across,  ///< at an end, where seams at the other end leave their line: Surface::ends_across
  nowhere,
};

/// Whether collapses keep to an edge.
enum class EdgeKind : std::uint8_t {
  smooth,
  seam,     ///< a feature that mark_seams marked, where the options allow to cross seams
  feature,  ///< any other feature
};

/// Unit normal and area of a face; a zero normal if it has no area. Loaded as four floats.
struct alignas(16) FaceShape {
  glm::vec3 normal{0.0F};
  float area = 0.0F;

  Vec3<float> area_vector() const { return {normal.x * area, normal.y * area, normal.z * area}; }
};

/// Four face shapes at once.
struct ShapeLanes {
  Vec3<Float4> normal;
  Float4 area;
};

/// Cost of an edge that must not be merged.
inline constexpr float kNever = std::numeric_limits<float>::infinity();

/// Data kept per face: half a cache line. The costs of its half-edges are the last known ones of
/// their edges. An edge stores its cost at one of its two half-edges, whose origin owns the edge.
/// The other one has kNever; both have it if the edge is refused or must not be merged.
struct alignas(32) FaceState {
  static constexpr bool kLeftUninitialized = true;  ///< written in parallel, then read

  FaceShape shape;
  std::array<float, 3> cost{kNever, kNever, kNever};
  std::uint32_t first_normal = 0;  ///< normal in the input, packed
};

/// Data kept per vertex: a cache line, because most of it is needed whenever a vertex is visited.
/// The quadric and a copy of the position, twelve floats, are loaded as three times four.
///
/// `cost` and `best` describe the cheapest edge that the vertex owns, so the queue has one entry
/// per vertex.
struct alignas(64) VertexState {
  static constexpr bool kLeftUninitialized = true;  ///< written in parallel, then read
  static constexpr std::uint32_t kGone = (1U << 29U) - 1;

  Quadric<float> quadric{};
  Vec3<float> position{};
  float cost = kNever;  ///< of `best` when it was chosen
  Halfedge best;        ///< cheapest half-edge out of the vertex; if removed: see merged_into
  /// The only region that may change the vertex; kGone: removed. Regions around read this word.
  std::uint32_t region : 29 = 0;
  bool is_guarded : 1 = false;  ///< its collapses are checked for new intersections
  /// Same as `constraint`, as if there were no seams (EdgeKind::seam).
  VertexConstraint constraint_across : 2 = VertexConstraint::free;
  /// Highest CollapseRecord::rank of the collapses whose one-rings contained the vertex.
  std::uint16_t rank : 13 = 0;
  bool has_refused : 1 = false;  ///< one of its edges was refused because of its surroundings
  VertexConstraint constraint : 2 = VertexConstraint::free;
  std::uint16_t retreat_bits = 0;
  /// How far the surface around has retreated (appraisal.h): 8 significant bits, rounded down.
  float retreat() const { return std::bit_cast<float>(std::uint32_t{retreat_bits} << 16U); }
  void set_retreat(float d) { retreat_bits = std::bit_cast<std::uint32_t>(d) >> 16U & 0xFFFFU; }
  void set_region(std::uint32_t new_region) { region = new_region & kGone; }
  void set_rank(std::uint32_t new_rank) { rank = new_rank & 0x1FFFU; }
  /// The vertex into which a removed vertex was merged.
  Vertex merged_into() const { return Vertex(best.index()); }
  void remove(Vertex into) {
    region = kGone;
    best = Halfedge(into.index());
  }
};

/// Several vertex states at once.
template <class F>
struct StateLanes {
  Quadric<F> quadric;
  Vec3<F> position;
};
static_assert(sizeof(FaceState) == 32 && sizeof(VertexState) == 64);

}  // namespace mesher::simplify
