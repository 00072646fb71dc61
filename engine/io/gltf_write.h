#pragma once

#include <span>

#include "engine/core/progress.h"
#include "engine/io/atomic_file.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/material.h"
#include "engine/mesh/mesh.h"

namespace mesher::io {

/// A mesh at one level of detail.
struct GltfLevel {
  const Mesh* mesh;
  const Attributes* attributes;
  /// Minimum screen coverage of this level: the fraction of the screen's area that the model
  /// covers.
  double least_coverage = 0.0;
};

struct GltfWriteOptions {
  bool binary = false;
  bool compresses = false;  ///< by EXT_meshopt_compression, as `compress` describes
  glm::dvec3 origin{0.0};
  const Materials* materials = nullptr;  ///< null: there are none
  Progress* progress = nullptr;
};

/// Writes glTF 2.0, binary (.glb) or as text with the data embedded (.gltf, a single file).
///
/// Writes positions, normals if every corner has one, texture coordinates and colors. Texture
/// coordinates are flipped to count from the top, as in glTF; missing ones are 0. A vertex is
/// repeated where the attributes of its corners differ. The node is translated by `origin`. Does
/// not commit. O(F). Throws OutputError for an empty mesh, and for a .glb of more than 4 GB, the
/// limit of the format.
///
/// If there are materials, the faces of each are a primitive, and all primitives have the same
/// vertices. The images that glTF can hold are embedded.
void write_gltf(AtomicFile& file, const Mesh& mesh, const Attributes& attributes,
                const GltfWriteOptions& options);

/// Writes levels of detail, finest first, with one node per level.
///
/// Only the first node is in the scene. It names the others with the extension MSFT_lod, and its
/// extras.MSFT_screencoverage lists the coverages. A program that does not know the extension shows
/// the finest level. Pre: `levels` is not empty.
void write_gltf(AtomicFile& file, std::span<const GltfLevel> levels,
                const GltfWriteOptions& options);

}  // namespace mesher::io
