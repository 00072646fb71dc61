#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>

#include "engine/mesh/mesh.h"

namespace mesher {

/// The reason why an edge may not be collapsed.
enum class CollapseVerdict : std::uint8_t {
  legal,
  /// The ends have a common neighbor that is not opposite the edge in one of its faces: three faces
  /// would meet at an edge, or a boundary loop of three edges would close.
  link_condition,
  /// An interior edge between two boundary vertices: the surface would be pinched.
  pinches_boundary,
  /// Both other sides of a face at the edge are boundary: its third vertex would be left without a
  /// face.
  leaves_vertex,
  /// The edge is part of a tetrahedron: two faces would coincide.
  tetrahedron,
};

/// Returns the verdict in the words of reports and panels: "link condition".
std::string_view describe(CollapseVerdict verdict);

/// The result of check_collapse, with the offending vertex if there is one.
struct CollapseCheck {
  CollapseVerdict verdict = CollapseVerdict::legal;
  Vertex blamed;

  bool is_legal() const { return verdict == CollapseVerdict::legal; }
};

/// Returns whether collapsing the edge of `h` leaves an oriented manifold of the same topology: the
/// same components, Euler characteristic and boundary loops. This is the link condition (T. Dey, H.
/// Edelsbrunner, S. Guha, D. Nekhayev, "Topology preserving edge contraction", 1999), with the
/// boundary coned off to a vertex of its own. It does not check shape. O(k log k) in the valences
/// of the ends.
CollapseCheck check_collapse(const Mesh& mesh, Halfedge h);

/// The changes of ids that a collapse made, for code that stores ids. The last vertices and faces
/// moved into the holes, so that ids stay contiguous.
struct CollapseResult {
  struct Move {
    std::uint32_t from = kNone;
    std::uint32_t to = kNone;
    friend bool operator==(const Move&, const Move&) = default;
  };
  Vertex kept;                     ///< the current id of target(h)
  Move vertex_move;                ///< invalid (kNone) if the removed vertex was the last one
  std::array<Move, 2> face_moves;  ///< in the order of execution
  std::uint32_t removed_faces = 0;
};

/// Removes origin(h) and the one or two faces at the edge, and moves target(h) to `p`. Two edges
/// that become one keep the larger sharpness. A copy of a bow-tie vertex that moves is no longer a
/// copy. Notes the changes in the change log. O(valence of both ends, of the last vertex, and of
/// the faces' third vertices). Pre: check_collapse(mesh, h).is_legal(), `p` finite.
CollapseResult collapse(Mesh& mesh, Halfedge h, const glm::vec3& p);

}  // namespace mesher
