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

}  // namespace mesher::render
