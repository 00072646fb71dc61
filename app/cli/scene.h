#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/document/json.h"
#include "engine/io/atomic_file.h"
#include "engine/io/gltf_rewrite.h"
#include "engine/io/gltf_scene.h"
#include "engine/simplify/shapes.h"

namespace mesher::app {

/// A glTF file that a command edits mesh by mesh and writes as glTF again.
struct LoadedScene {
  std::filesystem::path file;
  std::unique_ptr<io::GltfScene> scene;
  std::vector<io::GltfSceneMesh> meshes;  ///< those with triangles
  BuildReport report;                     ///< of all meshes
  double diagonal = 0.0;                  ///< of the scene
  bool shows_any = false;                 ///< the scene shows a mesh with triangles

  /// How often a mesh counts: as often as the scene shows it, or once if it shows none.
  std::uint64_t weight(const io::GltfSceneMesh& mesh) const {
    return shows_any ? mesh.placements : 1;
  }
  /// Number of faces that the scene shows.
  std::uint64_t face_count() const;
  std::uint64_t vertex_count() const;
};

/// Returns whether input and output are glTF, so that everything but the edited meshes is kept.
/// Throws UsageError if the output should be compressed and is not glTF.
bool keeps_scene(const InputOptions& input, const std::string& output, const CommonOptions& common);

/// Reads a scene with all its meshes, as the options say, and tags creases. Shows progress on a
/// terminal. Prints what was repaired, unless `common.quiet`. Throws InputError.
LoadedScene load_scene(const InputOptions& input, const CommonOptions& common);

/// As load_scene; throws InputError if no mesh has triangles: "has no faces to simplify".
LoadedScene load_scene_with_faces(const InputOptions& input, const CommonOptions& common,
                                  const char* what);

/// Returns the meshes of a scene for simplification. They refer to those of `scene`.
std::vector<simplify::SceneShape> shapes_of(const LoadedScene& scene);

/// Returns a share of the faces that the scene shows, at least 1.
std::uint64_t scene_faces_for(double ratio, const LoadedScene& scene);

/// Returns an edit that replaces a mesh by what its model is now.
io::GltfMeshEdit edit_of(const io::GltfSceneMesh& mesh);

/// Writes the scene with some meshes edited, and does not commit. With `common.compresses` all
/// meshes are compressed, also those without an edit. Returns what the file does not hold of the
/// input. Throws OutputError.
std::vector<std::string> write_scene(io::AtomicFile& file, LoadedScene& scene,
                                     std::vector<io::GltfMeshEdit> edits,
                                     const CommonOptions& common);

/// Does that and commits. Unless `common.quiet`, also prints on stderr what the file does not hold.
std::vector<std::string> write_scene(const std::string& output, LoadedScene& scene,
                                     std::vector<io::GltfMeshEdit> edits,
                                     const CommonOptions& common);

/// Prints the size of what was written.
void say_scene(const std::string& output, const LoadedScene& scene);

/// The name of a mesh for messages: its own, or its number.
std::string name_of(const io::GltfSceneMesh& mesh);

}  // namespace mesher::app
