#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <vector>

#include "engine/io/gltf_file.h"
#include "engine/io/mapped_file.h"
#include "engine/io/read.h"
#include "engine/mesh/contents.h"
#include "engine/mesh/model.h"
#include "engine/mesh/statistics.h"
#include "engine/scene/scene.h"

namespace mesher::io {

/// A mesh of a scene with triangles, in its own coordinates.
struct GltfSceneMesh {
  std::uint64_t index = 0;  ///< in the document
  Model model;
  std::uint64_t placements = 0;  ///< how often the default scene shows it, with instances
  /// Factor of lengths from the mesh to the scene, the largest of all placements; 1 if there is
  /// none.
  double scale = 1.0;
};

/// A glTF file with each of its meshes as a model that can be edited.
class GltfScene {
 public:
  /// Reads the document and notes its contents. Throws InputError; Cancelled.
  /// `keep`: how the bytes of its files are kept.
  GltfScene(const std::filesystem::path& file, const ReadOptions& options = {},
            Keep keep = Keep::mapped);

  /// The document. Non-const, because buffers are opened when they are needed.
  GltfFile& document() { return gltf_; }
  const FileContents& contents() const { return contents_; }
  /// How the document arranges its meshes. Whether they have triangles is not known yet.
  const scene::Scene& graph() const { return graph_; }

  /// Reads all meshes that have triangles, each once, however often it is shown. Their sizes have
  /// the limits of read_gltf. O(size). Throws InputError; Cancelled.
  std::vector<GltfSceneMesh> read_meshes(const ReadOptions& options = {});

  /// Returns a box around the meshes as the default scene shows them: around their boxes, of which
  /// that of a skinned mesh follows its first joint. Without placements, around the meshes.
  Box bounds(const std::vector<GltfSceneMesh>& meshes) const;

 private:
  std::vector<GltfSceneMesh> read_meshes_once(const ReadOptions& options);

  MappedFile file_;
  GltfFile gltf_;
  GltfFile::Reports reports_{gltf_, nullptr};  ///< outside of the functions that have a progress
  FileContents contents_;
  scene::Scene graph_;
};

}  // namespace mesher::io
