#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <unordered_map>

#include "engine/io/draco_mesh.h"
#include "engine/io/gltf_file.h"

namespace mesher::io {

/// A primitive with KHR_draco_mesh_compression, decoded.
struct PackedPrimitive {
  DracoMesh mesh;
  std::map<std::string, std::size_t> names;  ///< of attributes, with their index in the mesh

  /// As GltfFile::floats. Pre: the attribute is there, and first + count <= mesh.points.
  Array<float> values(const std::string& name, std::size_t components, std::size_t first,
                      std::size_t count) const;
};

/// The compressed primitives of a document. Each is decoded once for all instances of its mesh,
/// unless there is too much data to keep.
class PackedPrimitives {
 public:
  /// Returns a primitive, decoded, or null if it is not compressed. Valid until the next call.
  /// Throws InputError.
  const PackedPrimitive* find(GltfFile& gltf, const GltfFile::Json& primitive, Progress* progress);

 private:
  std::unordered_map<const GltfFile::Json*, PackedPrimitive> known_;
  std::size_t values_ = 0;  ///< in known_
};

}  // namespace mesher::io
