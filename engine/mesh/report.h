#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/core/choice.h"

namespace mesher {

/// What building a mesh from a file's polygons changed or noticed, by kind.
enum class Repair : std::uint8_t {
  polygons_triangulated,        ///< faces of four and more corners
  degenerate_faces_dropped,     ///< a vertex twice, or fewer than three corners
  duplicate_faces_dropped,      ///< the same three vertices as an earlier face
  non_finite_vertices_dropped,  ///< a coordinate was NaN or infinite
  non_finite_faces_dropped,     ///< faces that used one
  faces_flipped,                ///< turned around to agree with their neighbours
  unorientable_edges_cut,       ///< where a one-sided surface (Moebius) cannot agree with itself
  non_manifold_edges_cut,       ///< edges of three and more faces
  non_manifold_vertices_cut,    ///< several fans met, or a cut edge ended there
  isolated_vertices_dropped,    ///< no face used them
  isolated_vertices_kept,       ///< no face uses them; kept on request
  creases_on_missing_edges,     ///< between vertices that no edge joins, or on a missing vertex
  invalid_sharpness_ignored,    ///< NaN or negative
  contradictory_creases,        ///< tagged twice with different values; the last counts
};
inline constexpr Choices<Repair, 14> kRepairs{{
    {Repair::polygons_triangulated, {"polygons_triangulated", "polygons triangulated"}},
    {Repair::degenerate_faces_dropped, {"degenerate_faces_dropped", "degenerate faces dropped"}},
    {Repair::duplicate_faces_dropped, {"duplicate_faces_dropped", "duplicate faces dropped"}},
    {Repair::non_finite_vertices_dropped,
     {"non_finite_vertices_dropped", "non-finite vertices dropped"}},
    {Repair::non_finite_faces_dropped,
     {"non_finite_faces_dropped", "faces with a non-finite vertex dropped"}},
    {Repair::faces_flipped, {"faces_flipped", "faces flipped to agree with their neighbors"}},
    {Repair::unorientable_edges_cut,
     {"unorientable_edges_cut", "edges of a one-sided surface cut"}},
    {Repair::non_manifold_edges_cut, {"non_manifold_edges_cut", "non-manifold edges cut"}},
    {Repair::non_manifold_vertices_cut, {"non_manifold_vertices_cut", "non-manifold vertices cut"}},
    {Repair::isolated_vertices_dropped, {"isolated_vertices_dropped", "isolated vertices dropped"}},
    {Repair::isolated_vertices_kept, {"isolated_vertices_kept", "isolated vertices kept"}},
    {Repair::creases_on_missing_edges,
     {"creases_on_missing_edges", "creases on missing edges ignored"}},
    {Repair::invalid_sharpness_ignored,
     {"invalid_sharpness_ignored", "invalid sharpness values ignored"}},
    {Repair::contradictory_creases,
     {"contradictory_creases", "contradictory creases (the last counts)"}},
}};
static_assert(is_complete(kRepairs));
constexpr const auto& choices(Repair) {
  return kRepairs;
}

/// Counts by kind. All zero: the file was a clean manifold as it stood.
class BuildReport {
 public:
  std::uint64_t& operator[](Repair repair) { return counts_[static_cast<std::size_t>(repair)]; }
  std::uint64_t operator[](Repair repair) const {
    return counts_[static_cast<std::size_t>(repair)];
  }
  bool is_clean() const;

 private:
  std::array<std::uint64_t, kRepairs.size()> counts_{};
};

}  // namespace mesher
