#pragma once

#include <vector>

#include "engine/io/gltf_file.h"
#include "engine/io/read.h"
#include "engine/scene/animation.h"

namespace mesher::io {

/// Returns the animations of a document, in its order; their channels are valid. Channels without a
/// node are left out, and so are those of properties that glTF itself does not define, such as the
/// ones of KHR_animation_pointer. O(bytes). Throws InputError if times do not rise, sizes do not
/// agree, an index is out of range, or the channels repeat their data too often for the size of the
/// file.
std::vector<scene::Animation> read_gltf_animations(GltfFile& gltf);

/// Gives the nodes of a document the pose of an animation at a time, in memory: whatever reads the
/// nodes afterwards sees the pose. Reads no other animation. Throws as read_gltf_animations, and
/// InputError with the names that there are if there is no such animation.
void pose_gltf(GltfFile& gltf, const PoseChoice& choice);

}  // namespace mesher::io
