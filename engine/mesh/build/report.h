#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/core/choice.h"

namespace mesher {

/// The kinds of changes and findings when a mesh is built from a file's polygons.
enum class Repair : std::uint8_t {
  polygons_triangulated,        ///< faces with four or more corners
  degenerate_faces_dropped,     ///< a vertex used twice, or fewer than three corners
  duplicate_faces_dropped,      ///< the same three vertices as an earlier face
  non_finite_vertices_dropped,  ///< with a NaN or infinite coordinate
  non_finite_faces_dropped,     ///< faces that use such a vertex
  faces_flipped,                ///< to agree with their neighbors
  unorientable_edges_cut,       ///< on a one-sided surface (Moebius strip)
  non_manifold_edges_cut,       ///< edges of three or more faces
  non_manifold_vertices_cut,    ///< several fans meet, or a cut edge ends there
  isolated_vertices_dropped,    ///< no face uses them
  isolated_vertices_kept,       ///< no face uses them; kept on request
  creases_on_missing_edges,     ///< between vertices without an edge, or on a missing vertex
  invalid_sharpness_ignored,    ///< NaN or negative
  contradictory_creases,        ///< tagged twice with different values; the last one is used
  vertices_joined,              ///< with another at an equal position
  close_vertices_joined,        ///< with another within the distance asked for
  second_sides_kept,            ///< faces on the vertices of another, with vertices of their own
  attribute_indices_ignored,    ///< of a texture coordinate or normal that does not exist
  invalid_normals_ignored,      ///< that are not numbers
  facet_counts_corrected,       ///< in the header of an STL; the size of the file gives the count
  header_lines_skipped,         ///< that the format does not define
};
/// The labels are phrases for count_phrase.
inline constexpr Choices<Repair, 21> kRepairs{{
    {Repair::polygons_triangulated, {"polygons_triangulated", "{polygon|polygons} triangulated"}},
    {Repair::degenerate_faces_dropped,
     {"degenerate_faces_dropped", "degenerate {face|faces} dropped"}},
    {Repair::duplicate_faces_dropped,
     {"duplicate_faces_dropped", "duplicate {face|faces} dropped"}},
    {Repair::non_finite_vertices_dropped,
     {"non_finite_vertices_dropped", "non-finite {vertex|vertices} dropped"}},
    {Repair::non_finite_faces_dropped,
     {"non_finite_faces_dropped", "{face|faces} with a non-finite vertex dropped"}},
    {Repair::faces_flipped,
     {"faces_flipped", "{face|faces} flipped to agree with {its|their} neighbors"}},
    {Repair::unorientable_edges_cut,
     {"unorientable_edges_cut", "{edge|edges} of a one-sided surface cut"}},
    {Repair::non_manifold_edges_cut, {"non_manifold_edges_cut", "non-manifold {edge|edges} cut"}},
    {Repair::non_manifold_vertices_cut,
     {"non_manifold_vertices_cut", "non-manifold {vertex|vertices} cut"}},
    {Repair::isolated_vertices_dropped,
     {"isolated_vertices_dropped", "isolated {vertex|vertices} dropped"}},
    {Repair::isolated_vertices_kept, {"isolated_vertices_kept", "isolated {vertex|vertices} kept"}},
    {Repair::creases_on_missing_edges,
     {"creases_on_missing_edges", "{crease on a missing edge|creases on missing edges} ignored"}},
    {Repair::invalid_sharpness_ignored,
     {"invalid_sharpness_ignored", "invalid sharpness {value|values} ignored"}},
    {Repair::contradictory_creases,
     {"contradictory_creases", "contradictory {crease|creases} (the last one is used)"}},
    {Repair::vertices_joined,
     {"vertices_joined", "{vertex|vertices} joined with another at the same position"}},
    {Repair::close_vertices_joined,
     {"close_vertices_joined", "{vertex|vertices} joined with another within the distance"}},
    {Repair::second_sides_kept,
     {"second_sides_kept",
      "{face|faces} on the vertices of another kept as a second side, with vertices of its own"}},
    {Repair::attribute_indices_ignored,
     {"attribute_indices_ignored",
      "{index|indices} of a missing texture coordinate or normal ignored"}},
    {Repair::invalid_normals_ignored,
     {"invalid_normals_ignored",
      "{normal that is not a number|normals that are not numbers} ignored"}},
    {Repair::facet_counts_corrected,
     {"facet_counts_corrected",
      "wrong facet {count|counts} in the header corrected by the size of the file"}},
    {Repair::header_lines_skipped, {"header_lines_skipped", "unknown header {line|lines} skipped"}},
}};
static_assert(is_complete(kRepairs));
constexpr const auto& choices(Repair) {
  return kRepairs;
}

/// The number of repairs of each kind. Clean: a manifold, with nothing to do but join vertices.
class BuildReport {
 public:
  std::uint64_t& operator[](Repair repair) { return counts_[static_cast<std::size_t>(repair)]; }
  std::uint64_t operator[](Repair repair) const {
    return counts_[static_cast<std::size_t>(repair)];
  }
  bool is_clean() const;
  /// Adds the counts of another part of the model.
  BuildReport& operator+=(const BuildReport& other);

 private:
  std::array<std::uint64_t, kRepairs.size()> counts_{};
};

}  // namespace mesher
