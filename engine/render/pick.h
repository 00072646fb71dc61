#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "engine/mesh/mesh.h"
#include "engine/render/camera.h"

namespace mesher::render {

struct Hit {
  Face face;
  glm::dvec3 point{0.0};
  double distance = 0.0;  ///< along the ray
};

/// Returns the nearest face hit by a ray from either side, or none (T. Moeller, B. Trumbore, "Fast,
/// minimum storage ray/triangle intersection", 1997, in double). Returns the lower face if two are
/// equally near. O(F), parallel: fast enough per click, too slow per frame.
std::optional<Hit> pick(const Mesh& mesh, const Ray& ray);

struct EdgeHit {
  Edge edge;
  double distance_px = 0.0;  ///< from the cursor to the edge, in the window
};

/// Returns the edge under the cursor.
///
/// If there is a face under the cursor, returns the face's edge nearest to the cursor in the
/// window. Otherwise returns the nearest of all edges (the outline). Returns none if the edge is
/// farther than `tolerance_px`. `cursor` is in pixels. O(F), parallel: fast enough per click or
/// hover, too slow per frame.
std::optional<EdgeHit> pick_edge(const Mesh& mesh, const Camera& camera, const Cursor& cursor,
                                 double tolerance_px = 8.0);

}  // namespace mesher::render
