#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>

#include "engine/mesh/mesh.h"

namespace mesher {

/// What stands against collapsing an edge.
enum class CollapseVerdict : std::uint8_t {
  legal,
  /// The ends have a common neighbour that is not across one of the edge's faces: three faces would
  /// meet in an edge, or a boundary loop of three edges would close.
  link_condition,
  /// An inner edge between two boundary vertices: the surface would be pinched.
  pinches_boundary,
  /// A face of the edge is joined to the rest by one side or none: its third vertex would be left
  /// over.
  leaves_vertex,
  /// The edge is part of a tetrahedron: two faces would fall together.
  tetrahedron,
};

/// "link condition": as reports and panels say it.
std::string_view describe(CollapseVerdict verdict);

/// The answer to "may this edge be collapsed?", with the vertex to blame where there is one.
struct CollapseCheck {
  CollapseVerdict verdict = CollapseVerdict::legal;
  Vertex blamed;

  bool is_legal() const { return verdict == CollapseVerdict::legal; }
};

/// Whether collapsing the edge of `h` leaves an oriented manifold of the same topology: components,
/// Euler characteristic and boundary loops stay what they are. It is the link condition (T. Dey,
/// H. Edelsbrunner, S. Guha, D. Nekhayev, "Topology preserving edge contraction", 1999), the
/// boundary coned off to a vertex of its own. Says nothing of shape. O(k log k) in the valences of
/// the ends.
CollapseCheck check_collapse(const Mesh& mesh, Halfedge h);

/// What an edit did to ids, so that whoever keeps some can follow. Faces and vertices past the end
/// moved into the holes, so that the live ones stay a prefix.
struct CollapseResult {
  struct Move {
    std::uint32_t from = kNone;
    std::uint32_t to = kNone;
    friend bool operator==(const Move&, const Move&) = default;
  };
  Vertex kept;                     ///< where target(h) is now
  Move vertex_move;                ///< invalid (kNone) where the last vertex was the one removed
  std::array<Move, 2> face_moves;  ///< in the order in which they happened
  std::uint32_t removed_faces = 0;
};

/// Removes origin(h) and the one or two faces at the edge, moves target(h) to `p`. Two edges that
/// fall together keep the larger sharpness. A copy of a bow-tie vertex that does not stay where it
/// was is no copy any more. O(valence of both ends, of the last vertex, and of the faces' third
/// vertices); notes what it touched.
/// Pre: check_collapse(mesh, h).is_legal(), `p` finite.
CollapseResult collapse(Mesh& mesh, Halfedge h, const glm::vec3& p);

}  // namespace mesher
