#pragma once

#include <cstdint>
#include <vector>

#include "engine/progressive/progressive_mesh.h"

namespace mesher::test {

/// The mesh without its list of copies of bow-tie vertices.
Mesh without_copies(const Mesh& mesh);

/// Fails the test where the mesh at its level breaks an invariant of Mesh, or P1, P3 or P4 for the
/// next split.
void expect_valid_level(const ProgressiveMesh& mesh);

/// The mesh at each of these levels, gone to in this order.
std::vector<Mesh> levels(ProgressiveMesh& mesh, const std::vector<std::uint32_t>& at);

/// Some levels, the first and the last among them, about evenly spread.
std::vector<std::uint32_t> some_levels(const ProgressiveMesh& mesh, std::uint32_t count);

/// The same progressive mesh, made by appending its splits to a copy of its base.
ProgressiveMesh appended(ProgressiveMesh& mesh);

/// Fails the test where the two differ in anything: base, splits, moved corners, sharpness. Copies
/// of bow-tie vertices do not count: a mesh that is put together of splits lists none.
void expect_same(ProgressiveMesh& a, ProgressiveMesh& b);

/// Levels down and up, by steps and by jumps, are the same arrays, and valid.
void examine_levels(ProgressiveMesh& mesh, std::uint32_t count);

}  // namespace mesher::test
