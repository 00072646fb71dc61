#pragma once

#include "engine/core/progress.h"
#include "engine/io/gltf_file.h"
#include "engine/scene/scene.h"

namespace mesher::io {

/// Returns how a document arranges its meshes: nodes, skins, and where each mesh is placed. A
/// document without nodes shows each mesh once. `to_scene` is that of the first placement, or of
/// its first joint; the identity where that could not be undone. O(document). Throws InputError;
/// Cancelled.
scene::Scene read_scene_graph(GltfFile& gltf, const Progress* progress);

}  // namespace mesher::io
