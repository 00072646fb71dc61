#pragma once

#include <memory>

#include "engine/io/gltf_file.h"
#include "engine/mesh/contents.h"
#include "engine/mesh/material.h"

namespace mesher::io {

/// Number of materials of a document that are read. Further ones are only counted.
inline constexpr std::size_t kMostGltfMaterials = std::size_t{1} << 16;

/// Returns the materials of a glTF document with the images that they use, at the indices of the
/// document. Null if it has none.
///
/// Reads what struct Material holds. Of a texture with several sources the WebP image is taken,
/// else the plain one, else one in a container for GPUs (KTX2, DDS). Images come from buffer views,
/// data URIs, or files in or below the document's folder. A member of the wrong type counts as
/// absent, and an image that cannot be read gives a warning: the shape of a file does not suffer
/// from its look. O(bytes of the images).
std::shared_ptr<const Materials> read_gltf_materials(GltfFile& gltf, FileContents& contents);

}  // namespace mesher::io
