#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/io/gltf_budget.h"
#include "engine/io/gltf_file.h"
#include "engine/io/gltf_packed.h"
#include "engine/io/read.h"
#include "engine/mesh/model.h"

namespace mesher::io {

/// Returns the kind of a vertex attribute of glTF.
AttributeKind attribute_kind(std::string_view name);

/// Returns the name of the layer that holds an attribute of a morph target: "target 0 POSITION".
std::string morph_layer(std::size_t target, std::string_view attribute);

/// Returns the triangles of all primitives of a mesh as one model, in the mesh's own coordinates,
/// with all vertex attributes as they are stored, and those of morph targets.
///
/// Positions are joined as `options.weld` says, whichever primitives they belong to, so that
/// borders of materials are lines on one surface. The groups are the primitives with triangles, in
/// order. Corners of primitives without an attribute have no value. Where primitives store an
/// attribute in different types, it is kept in floats. Texture coordinates count from the top.
///
/// A mesh without triangles gives a model without faces. O(F + V log V). Throws InputError;
/// Cancelled.
Model read_gltf_mesh(GltfFile& gltf, PackedPrimitives& packed, GltfBudget& budget,
                     std::uint64_t mesh, const ReadOptions& options = {});

}  // namespace mesher::io
