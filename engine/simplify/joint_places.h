#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher::simplify {

/// Returns a vector per wedge that shows how far apart the parts are that its joints move: the mean
/// of the places of its joints, by weight. The place of a joint is the mean of all points that
/// follow it, so no skeleton is needed. Relative to the middle of all; 0 for a wedge without
/// joints. Empty if the mesh has no joints. O(wedges).
///
/// Where a collapse changes weights, these vectors change with them. A pose moves parts that are
/// far apart farther from each other than neighbors, so their joints should not mix.
std::vector<glm::dvec3> joint_places(const Mesh& mesh, const Attributes& attributes);

}  // namespace mesher::simplify
