#pragma once

#include <vector>

#include "engine/scene/placed.h"

namespace mesher::scene {

/// Adds the morph targets to positions and normals of copies, each times the weight of its copy.
/// `weights`: of each copy, by target. O(V * targets with weight).
void add_targets(const std::vector<std::vector<double>>& weights, Copies& copies);

}  // namespace mesher::scene
