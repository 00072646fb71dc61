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

/// The nearest face under a ray, from either side, or none (T. Moeller, B. Trumbore, "Fast, minimum
/// storage ray/triangle intersection", 1997, in double). The lower face where two are equally near.
/// O(F), parallel: a click, not a frame.
std::optional<Hit> pick(const Mesh& mesh, const Ray& ray);

struct EdgeHit {
  Edge edge;
  double distance_px = 0.0;  ///< from the cursor to the edge, in the window
};

/// The edge that a person points at: of the face under the cursor the edge nearest to it in the
/// window; where no face is, of all edges (those of the outline, that is). None farther than
/// `tolerance_px` counts. `cursor` is in pixels. O(F), parallel: a click, or a rest of the hand.
std::optional<EdgeHit> pick_edge(const Mesh& mesh, const Camera& camera, const Cursor& cursor,
                                 double tolerance_px = 8.0);

}  // namespace mesher::render
