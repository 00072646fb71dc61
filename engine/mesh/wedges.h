#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// Values that corners refer to by one index, such as the `vt` lines of an OBJ file or the vertices
/// of a glTF primitive.
struct AttributeStream {
  Array<std::uint32_t> index;          ///< one per corner; kNone: no value
  std::vector<AttributeLayer> layers;  ///< as many values each

  std::size_t count() const { return layers.empty() ? 0 : layers.front().count(); }
};

/// Returns the layers of all streams, with the wedges that follow from them. Corners of a vertex
/// are of one wedge if all their values are bitwise the same, wherever in the stream they are. A
/// corner without a value gets the one of `store_absent`, and is of no wedge that has a value.
///
/// Wedges are numbered by vertex, those of one vertex in the order of its corners, so the result
/// does not depend on the number of threads. O(F + V), parallel. Throws Cancelled. Pre: `index` has
/// 3F elements, each kNone or below the stream's count; no two layers have the same name.
Attributes make_wedges(const Mesh& mesh, std::vector<AttributeStream>&& streams,
                       Progress* progress = nullptr);

/// Adds layers that are given by corner (3F values), and replaces those of the same name. Groups
/// stay. O(F + V), parallel. Throws Cancelled.
void set_corner_layers(const Mesh& mesh, Attributes& attributes,
                       std::vector<AttributeLayer>&& layers, Progress* progress = nullptr);

/// Sets the normals from values per corner; does nothing if there are none. As set_corner_layers.
void set_normals(const Mesh& mesh, Attributes& attributes, std::span<const glm::vec3> normals,
                 Progress* progress = nullptr);

}  // namespace mesher
