#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/mesh/attributes.h"
#include "engine/simplify/simplify.h"

namespace mesher::simplify {

struct CarriedAttributes {
  Attributes attributes;
  /// Attributes that could not be carried over, as text for the user: "texture coordinates (seams
  /// at 12 of the vertices that are left)".
  std::vector<std::string> dropped;
};

/// The remaining mesh and the source of each vertex and face, as in Simplified.
struct Survivors {
  const Mesh& mesh;
  std::span<const Vertex> vertex_source;
  std::span<const Face> face_source;
  std::size_t vertices_before = 0;
};

/// Carries attributes over a simplification where this is unambiguous. A texture coordinate, normal
/// or color is kept if, at every surviving vertex, all corners of the input have bitwise the same
/// value. An attribute with a seam at a surviving vertex is dropped entirely. Groups follow their
/// faces. If nothing was collapsed, everything is kept. `origins` are those of the input, because
/// simplify consumes the mesh itself. O(faces before and after).
CarriedAttributes carry_attributes(const Attributes& before, std::span<const Vertex> origins,
                                   const Simplified& result);
/// Same, for a result that does not come from `simplify`, such as a level of a progressive mesh.
CarriedAttributes carry_attributes(const Attributes& before, std::span<const Vertex> origins,
                                   const Survivors& result);

}  // namespace mesher::simplify
