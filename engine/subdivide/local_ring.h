#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "engine/subdivide/features.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/options.h"

namespace mesher::subdivide {

/// A sharp vertex with its one-ring. A step of Loop subdivision maps the ring to the new ring of
/// the same vertex, so that one vertex can be followed to its limit alone, however long its
/// sharpness lasts. In double.
class LocalRing {
 public:
  /// Loads the ring of a vertex of `level`, whose features are `features`. O(valence).
  void gather(const LevelView& level, const Features& features, const SharpVertex& vertex,
              const SubdivideOptions& options);

  /// Subdivides until the limit is given by a mask, or has converged in double precision.
  /// O(valence) per step. It takes few steps, except for long-lasting semi-sharp edges and at
  /// DeRose's darts.
  void settle();

  /// Returns the limit position of the vertex. Pre: settled.
  glm::dvec3 limit_position() const;
  /// Returns unit normals of the limit surface, one per half-edge out of the vertex, in the order
  /// of `halfedges()`; creases split them. O(valence). Pre: settled.
  std::span<const glm::dvec3> limit_normals();
  /// Returns the half-edges out of the vertex, counterclockwise; on a boundary, from the first one
  /// on.
  std::span<const Halfedge> halfedges() const { return halfedges_; }

 private:
  struct Spoke {
    glm::dvec3 end;
    float sharpness = 0.0F;
    float near_left = 0.0F;  ///< sharpness of the half at the vertex on the next level
    float far_left = 0.0F;   ///< the same for the half at the other end
    VertexKind end_kind = VertexKind::smooth;
  };

  bool is_boundary() const { return spokes_.size() > halfedges_.size(); }
  const Spoke& after(std::size_t i) const { return spokes_[(i + 1) % spokes_.size()]; }
  const Spoke& before(std::size_t i) const {
    return spokes_[(i + spokes_.size() - 1) % spokes_.size()];
  }
  void note_sharpness(const LevelView& level, const Features& features, const SharpVertex& vertex,
                      Halfedge incoming);
  VertexKind kind() const;
  bool has_semi_sharp() const;
  void step();
  void converge();
  void center_on_vertex();
  glm::dvec3 next_vertex() const;
  glm::dvec3 next_end(std::size_t i, VertexKind kind) const;
  void decay_spoke_sharpness();
  glm::dvec3 smooth_normal() const;
  glm::dvec3 sector_normal(VertexKind own_kind, std::size_t first, std::size_t count) const;
  glm::dvec3 fan_normal(std::size_t first, std::size_t count) const;

  SubdivideOptions options_;
  glm::dvec3 vertex_{0.0};
  glm::dvec3 center_{0.0};  ///< the limit, if it was found by subdividing
  float own_ = 0.0F;
  std::vector<Halfedge> halfedges_;
  std::vector<Spoke> spokes_;
  std::vector<Spoke> next_spokes_;
  using SharpHalfedge = std::pair<Halfedge, std::uint32_t>;  ///< with the index of its sharp edge
  std::vector<SharpHalfedge> sharp_edges_;
  std::vector<std::size_t> sharp_;  ///< indices of the sharp spokes
  std::vector<glm::dvec3> normals_;
};

}  // namespace mesher::subdivide
