#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/mesh/shape.h"

namespace mesher {

/// Divides a mesh with its attributes into `count` parts, by the groups of its faces.
/// `part_of_group`: one number below `count` per group, or kNone for groups that are in no part.
/// Each part has the groups of its number, and elements in the order of the mesh. O(V + F). Pre:
/// the faces have groups; no vertex is used by faces of two parts. A vertex that no face uses is in
/// no part.
std::vector<Shape> split(const Mesh& mesh, const Attributes& attributes,
                         const std::vector<std::uint32_t>& part_of_group, std::size_t count);

/// Returns the bytes of layers that shapes gain when they are joined: a layer of one is laid out
/// for all. O(layers).
std::uint64_t joined_layer_bytes(const std::vector<Shape>& shapes);

/// Returns shapes as one, in this order. Layers of one name become one: if their types differ,
/// values are converted to one that holds both. Corners of shapes without a layer have no value
/// there (store_absent). A shape without groups gets one. O(V + F). Pre: they fit in 32-bit ids.
Shape joined(std::vector<Shape>&& shapes);

/// Turns all faces over: swaps their second and third corner. O(V + F).
void turn_over(Shape& shape);

}  // namespace mesher
