#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/io/atomic_file.h"
#include "engine/io/read.h"
#include "engine/mesh/model.h"
#include "engine/mesh/shape.h"
#include "engine/scene/scene.h"

namespace mesher::io {

/// Reads a glTF file as a model that holds each mesh once, however often the scene shows it, with
/// all its attributes, and with Model::scene. Positions are those of the first placement, about
/// Model::origin. A file whose meshes would need much more memory as one model is read without its
/// scene, with a warning. O(size). Throws InputError; Cancelled.
Model read_gltf_model(const std::filesystem::path& file, const ReadOptions& options);

/// Writes the file that a scene comes from once more, with the meshes of `shape` that are not what
/// they were. Everything else is kept, as GltfRewriter does. Does not commit. Returns what the file
/// does not hold of the one that was read. O(size of both). Throws OutputError; InputError if the
/// buffers of the file that was read are gone; Cancelled. Pre: Scene::source is that of
/// read_gltf_model.
std::vector<std::string> write_gltf_model(AtomicFile& file, const Shape& shape,
                                          const scene::Scene& scene, bool binary,
                                          Progress* progress);

}  // namespace mesher::io
