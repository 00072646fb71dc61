#pragma once

#include <span>

#include "engine/io/atomic_file.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// A mesh in one of its levels of detail.
struct GltfLevel {
  const Mesh* mesh;
  const Attributes* attributes;
  /// The level is for sizes on the screen down to this: the fraction of its area that the model
  /// covers.
  double least_coverage = 0.0;
};

/// Writes glTF 2.0, binary (.glb) or as text with the data inside it (.gltf, one file, whole or not
/// at all): positions, normals where every corner has one, texture coordinates (turned so that they
/// count from the top, as glTF has it; absent ones are 0) and colours. A vertex is repeated where
/// the attributes of its corners differ. Does not commit. O(F). Throws OutputError past 4 GB, which
/// the format cannot hold.
void write_gltf(AtomicFile& file, const Mesh& mesh, const Attributes& attributes, bool binary);

/// The same with levels of detail, the finest first: a node each, of which only the first is in the
/// scene; it names the others (extension MSFT_lod, the coverages in extras.MSFT_screencoverage). So
/// a program that does not know the extension shows the finest. Pre: there is one.
void write_gltf(AtomicFile& file, std::span<const GltfLevel> levels, bool binary);

}  // namespace mesher
