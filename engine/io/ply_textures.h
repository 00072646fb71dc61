#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/io/mapped_file.h"
#include "engine/mesh/build/soup.h"
#include "engine/mesh/material.h"

namespace mesher::io {

// PLY has no materials. MeshLab names the textures of a model in comments `TextureFile NAME`; with
// several of them, each face has the index of its texture in `property int texnumber`.

/// Collects the textures of the faces of a PLY file.
class PlyFaceTextures {
 public:
  explicit PlyFaceTextures(std::size_t textures) : textures_(textures) {}

  /// Notes the texture of the next face by its `texnumber`. Negative: none. Indices out of range
  /// are counted and mean none.
  void add_face(std::int64_t texnumber);
  /// Notes that the next face has the first texture: files with one texture have no `texnumber`.
  void add_face() { add_face(0); }
  /// Sets the groups of the soup, one for each texture, and warns of what was out of range. Does
  /// nothing if there are no textures.
  void finish(Soup& soup);

 private:
  std::size_t textures_;
  Array<std::uint32_t> group_;
  std::uint64_t out_of_range_ = 0;
};

/// Sets Soup::materials: a material for each texture, with its image as base color. Files in or
/// below the PLY's folder are opened; another one gives a warning.
void add_ply_materials(const MappedFile& ply, const std::vector<std::string>& textures, Soup& soup);

/// The textures of a model that PLY holds, in the order of their materials.
struct PlyTextures {
  std::vector<std::uint32_t> images;       ///< indices into Materials::images, each once
  std::vector<std::uint32_t> of_material;  ///< indices into `images`; kNone: no such texture
};

/// Returns the base color textures that have a file or bytes, use the first texture coordinates,
/// and do not transform them. O(materials).
PlyTextures ply_textures(const Materials& materials);

}  // namespace mesher::io
