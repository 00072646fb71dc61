#pragma once

#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <unordered_map>
#include <vector>

#include "engine/core/array.h"
#include "engine/io/gltf_file.h"
#include "engine/scene/scene.h"

namespace mesher::io {

/// Returns the transform of a node relative to its parent.
scene::Transform node_transform(const GltfFile& gltf, const GltfFile::Json& node);
/// The same as a matrix.
glm::dmat4 local_transform(const GltfFile& gltf, const GltfFile::Json& node);

/// Returns the transforms of the instances of a node with EXT_mesh_gpu_instancing, relative to the
/// node, or nothing if it has none. Throws InputError if there are more than `most`.
std::optional<std::vector<glm::dmat4>> instance_transforms(GltfFile& gltf,
                                                           const GltfFile::Json& node,
                                                           std::size_t most);

/// Transforms of nodes to the scene.
using NodeTransforms = std::unordered_map<std::uint64_t, glm::dmat4>;

/// Returns the joints of a skin. Throws InputError.
scene::Skin read_skin(GltfFile& gltf, std::uint64_t skin);

/// Returns for each joint of a skin the transform of vertices that follow it alone. The transform
/// of the node that holds the mesh does not count.
std::vector<glm::dmat4> joint_transforms(GltfFile& gltf, std::uint64_t skin,
                                         const NodeTransforms& nodes);

/// Returns the transform of each vertex of a primitive with joints and weights: the mean of those
/// of its joints by weight. Empty if the primitive has no joints. `values` returns four values for
/// each of the `count` vertices of an attribute, or nothing.
std::vector<glm::dmat4> vertex_transforms(
    const GltfFile& gltf, const std::function<Array<float>(const std::string&)>& values,
    const std::vector<glm::dmat4>& joints, std::size_t count);

/// Adds the morph targets of a primitive to values of its vertices, each times its default weight.
/// `key` is "POSITION" or "NORMAL".
void add_morph_targets(GltfFile& gltf, const GltfFile::Json& primitive,
                       const std::vector<double>& weights, const char* key, std::size_t first,
                       Array<glm::vec3>& values);

/// Returns the default weights of the morph targets of a node's mesh; those of the node count
/// first.
std::vector<double> morph_weights(const GltfFile& gltf, const GltfFile::Json& node);

/// Transforms a normal; leaves one that vanishes as it is.
void turn_normal(const glm::dmat3& of_normals, glm::vec3& n);

}  // namespace mesher::io
