#pragma once

#include <cstdint>
#include <vector>

#include "engine/progressive/progressive_attributes.h"
#include "engine/progressive/progressive_mesh.h"

namespace mesher::test {

/// Returns the mesh without its list of bow-tie copies.
Mesh without_copies(const Mesh& mesh);

/// Fails the test if the mesh at its level breaks an invariant of Mesh, or P1, P3 or P4 for the
/// next split.
void expect_valid_level(const progressive::ProgressiveMesh& mesh);

/// Fails the test if the attributes at their level break W1, W2 or W4, or those of a model. Pre:
/// the mesh is at the same level.
void expect_valid_level(const progressive::ProgressiveMesh& mesh,
                        const progressive::ProgressiveAttributes& attributes);

/// Returns the mesh at each of these levels, visited in this order.
std::vector<Mesh> levels(progressive::ProgressiveMesh& mesh, const std::vector<std::uint32_t>& at);

/// Returns about `count` levels, evenly spread, including the first and the last.
std::vector<std::uint32_t> some_levels(const progressive::ProgressiveMesh& mesh,
                                       std::uint32_t count);

/// Returns the same progressive mesh, built by appending its splits to a copy of its base.
progressive::ProgressiveMesh appended(progressive::ProgressiveMesh& mesh);

/// Fails the test if the two differ in base, splits, moved corners or sharpness. Bow-tie copies are
/// ignored, because a mesh assembled from splits lists none.
void expect_same(progressive::ProgressiveMesh& a, progressive::ProgressiveMesh& b);

/// Checks that levels reached by steps and by jumps, down and up, are valid and have equal arrays.
void examine_levels(progressive::ProgressiveMesh& mesh, std::uint32_t count);

}  // namespace mesher::test
