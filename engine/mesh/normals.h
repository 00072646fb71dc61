#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "engine/core/array.h"
#include "engine/core/choice.h"
#include "engine/core/progress.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// The weight of each face in the normal of its vertex.
enum class NormalWeight {
  angle,    ///< by the face's angle at the vertex (G. Thuermer, C. Wuethrich, 1998): independent of
            ///< the triangulation of a flat region
  area,     ///< by face area: the plain cross product, cheapest
  uniform,  ///< equal weights (H. Gouraud, 1971)
};
inline constexpr Choices<NormalWeight, 3> kNormalWeights{{
    {NormalWeight::angle,
     {"angle", "by angle", "By the face's angle at the vertex: independent of the triangulation."}},
    {NormalWeight::area, {"area", "by area", "By the face's area: large faces decide."}},
    {NormalWeight::uniform,
     {"uniform", "uniform", "All faces count the same: small faces bend the shading."}},
}};
static_assert(is_complete(kNormalWeights));
constexpr const auto& choices(NormalWeight) {
  return kNormalWeights;
}

/// Returns the unit normal of a face by the right-hand rule, or zero if the face has no area. O(1).
glm::vec3 face_normal(const Mesh& mesh, Face f);

/// Returns one unit normal per face. O(F), parallel.
Array<glm::vec3> face_normals(const Mesh& mesh);

/// Returns the unit normal of `v` from its one-ring, or zero if it has none (isolated vertex, or a
/// flat fan folded onto itself). O(valence).
glm::vec3 vertex_normal(const Mesh& mesh, Vertex v, NormalWeight weight = NormalWeight::angle);

/// Returns one unit normal per vertex, equal to vertex_normal up to rounding. O(V + F), because the
/// valences sum to 3F; parallel. Scratch memory: 12 bytes per face. Throws
/// Cancelled.
Array<glm::vec3> vertex_normals(const Mesh& mesh, NormalWeight weight = NormalWeight::angle,
                                Progress* progress = nullptr);

struct CornerNormalOptions {
  NormalWeight weight = NormalWeight::angle;
  /// Normals are split at edges whose face normals differ by more than this angle (0: at all edges,
  /// pi: at creases only).
  float crease_angle_rad = 3.14159265F;
  bool split_at_creases = true;  ///< also at edges with sharpness > 0
  /// Empty, or for each half-edge whether normals are split at its edge; the same for both halves.
  std::span<const std::uint8_t> splits{};
};

/// Returns one unit normal per half-edge (for its corner). The faces around each vertex are grouped
/// into runs between split edges, and each run is averaged. O(V + F), parallel.
Array<glm::vec3> corner_normals(const Mesh& mesh, const CornerNormalOptions& options);

/// Recomputes the normals of the corners at one vertex, `normals[h]`, for an edit near `v`.
/// O(valence).
void update_corner_normals(const Mesh& mesh, Vertex v, const CornerNormalOptions& options,
                           Array<glm::vec3>& normals);

}  // namespace mesher
