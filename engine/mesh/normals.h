#pragma once

#include <glm/vec3.hpp>

#include "engine/core/array.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// How the faces around a vertex are weighted in its normal.
enum class NormalWeight {
  uniform,  ///< each face counts the same (H. Gouraud, 1971)
  area,     ///< by face area: the cross product as it comes, cheapest
  angle,    ///< by the face's angle at the vertex (G. Thuermer, C. Wuethrich, 1998): independent of
            ///< how a flat region is cut into triangles
};

/// Unit normal of a face, by the right-hand rule; zero where the face has no area. O(1).
glm::vec3 face_normal(const Mesh& mesh, Face f);

/// One unit normal a face. O(F) time, parallel.
Array<glm::vec3> face_normals(const Mesh& mesh);

/// Unit normal of `v`, by a walk around its one-ring; zero where it has none (isolated vertex, flat
/// fan folded on itself). O(valence).
glm::vec3 vertex_normal(const Mesh& mesh, Vertex v, NormalWeight weight = NormalWeight::angle);

/// One unit normal a vertex, as vertex_normal gives it to within rounding. The sum of the valences
/// is 3F, so the walks are O(V + F) in all; parallel. 12 bytes a face of scratch.
Array<glm::vec3> vertex_normals(const Mesh& mesh, NormalWeight weight = NormalWeight::angle);

struct CornerNormalOptions {
  NormalWeight weight = NormalWeight::angle;
  /// Normals are split at an edge whose faces meet at more than this angle (0: everywhere, pi:
  /// nowhere but at creases).
  float crease_angle_rad = 3.14159265F;
  bool split_at_creases = true;  ///< also at edges with sharpness > 0
};

/// One unit normal a half-edge (for its corner). Around each vertex the faces are grouped into runs
/// between split edges, and each run is averaged. O(V + F), parallel.
Array<glm::vec3> corner_normals(const Mesh& mesh, const CornerNormalOptions& options);

/// The same for the corners at one vertex, written to `normals[h]`: what an edit near `v` needs.
/// O(valence).
void update_corner_normals(const Mesh& mesh, Vertex v, const CornerNormalOptions& options,
                           Array<glm::vec3>& normals);

}  // namespace mesher
