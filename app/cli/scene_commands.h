#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/lods_command.h"
#include "app/cli/options.h"
#include "app/cli/simplify_command.h"
#include "engine/subdivide/options.h"

namespace mesher::app {

// The commands on a glTF file that is written as glTF again: mesh by mesh, and everything else as
// it was. keeps_scene (app/cli/scene.h) tells.

/// Copies a scene: every vertex in its order, nothing repaired. `repairs`: builds each mesh instead
/// and writes what came out.
void convert_scene(const InputOptions& input, const std::string& output, bool repairs,
                   const CommonOptions& common);

/// Simplifies all meshes to one budget of faces, by error in the scene (ShapesReducer), or within
/// the same distance in the scene. A number of faces is that of the scene, where a mesh counts as
/// often as it is shown.
void simplify_scene(const InputOptions& input, const std::string& output,
                    const SimplifyArguments& arguments, const CommonOptions& common);

void subdivide_scene(const InputOptions& input, const std::string& output,
                     const subdivide::SubdivideOptions& options, const CommonOptions& common);

/// Writes levels of a scene; each has one budget, or one error, for all meshes. Into one file,
/// where each node that shows a mesh lists its levels by MSFT_lod; or into `files`, one scene per
/// level, with a manifest.
void write_scene_lods(const InputOptions& input, const std::string& output,
                      const std::vector<std::filesystem::path>& files,
                      const LodArguments& arguments, const CommonOptions& common);

}  // namespace mesher::app
