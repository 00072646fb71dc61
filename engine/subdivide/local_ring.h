#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "engine/subdivide/features.h"
#include "engine/subdivide/level.h"
#include "engine/subdivide/options.h"

namespace mesher {

/// A sharp vertex with its neighbours, which a step of Loop subdivision maps to the same: so it can
/// be followed to the limit alone, however long its sharpness lasts. In double precision.
class LocalRing {
 public:
  /// The ring of a vertex of `level`, whose features are `features`. O(valence).
  void gather(const LevelView& level, const Features& features, const SharpVertex& vertex,
              const SubdivideOptions& options);

  /// Follows the vertex until its limit is known by a mask, or is as near as doubles get.
  /// O(valence) a step; few steps but where semi-sharp edges last long and at DeRose's darts.
  void settle();

  /// Where the vertex goes in the end. Pre: settled.
  glm::dvec3 limit_position() const;
  /// Unit normals of the limit surface, one for each half-edge out of the vertex, in the order of
  /// `halfedges()`: creases split them. Pre: settled. O(valence).
  std::span<const glm::dvec3> limit_normals();
  /// The half-edges out of the vertex, counter-clockwise, on a boundary from its start on.
  std::span<const Halfedge> halfedges() const { return halfedges_; }

 private:
  struct Spoke {
    glm::dvec3 end;
    float sharpness = 0.0F;
    float near_left = 0.0F;  ///< what is left of it at the vertex
    float far_left = 0.0F;   ///< and at the other end
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
  void centre_on_vertex();
  glm::dvec3 next_vertex() const;
  glm::dvec3 next_end(std::size_t i, VertexKind kind) const;
  void decay_spoke_sharpness();
  glm::dvec3 smooth_normal() const;
  glm::dvec3 sector_normal(VertexKind own_kind, std::size_t first, std::size_t count) const;
  glm::dvec3 fan_normal(std::size_t first, std::size_t count) const;

  SubdivideOptions options_;
  glm::dvec3 vertex_{0.0};
  glm::dvec3 centre_{0.0};  ///< the limit, where it was found by following the ring
  float own_ = 0.0F;
  std::vector<Halfedge> halfedges_;
  std::vector<Spoke> spokes_;
  std::vector<Spoke> next_spokes_;
  using SharpHalfedge = std::pair<Halfedge, std::uint32_t>;  ///< and which sharp edge it is of
  std::vector<SharpHalfedge> sharp_edges_;
  std::vector<std::size_t> sharp_;  ///< spokes that are sharp
  std::vector<glm::dvec3> normals_;
};

}  // namespace mesher
