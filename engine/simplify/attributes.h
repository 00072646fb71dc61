#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/mesh/attributes.h"
#include "engine/simplify/simplify.h"

namespace mesher {

struct CarriedAttributes {
  Attributes attributes;
  /// What could not be carried, as a person would read it: "texture coordinates (seams at 12 of the
  /// vertices that are left)".
  std::vector<std::string> dropped;
};

/// What a simplification has left, and where it comes from, as Simplified says it.
struct Survivors {
  const Mesh& mesh;
  std::span<const Vertex> vertex_source;
  std::span<const Face> face_source;
  std::size_t vertices_before = 0;
};

/// Carries attributes over a simplification where that is plain: a texture coordinate, normal or
/// color stays where, at every surviving vertex, all corners of the input say the same, bit for
/// bit; one that has a seam at a survivor is dropped whole. Groups follow their faces. Where
/// nothing was collapsed everything stays. `origins` are the input's (simplify takes the mesh
/// itself over). O(faces before and after).
CarriedAttributes carry_attributes(const Attributes& before, std::span<const Vertex> origins,
                                   const Simplified& result);
/// The same for what something else than `simplify` has left of the input, such as a level of a
/// progressive mesh.
CarriedAttributes carry_attributes(const Attributes& before, std::span<const Vertex> origins,
                                   const Survivors& result);

}  // namespace mesher
