#include "engine/scene/scene.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace mesher::scene {

glm::dmat4 Transform::to_matrix() const {
  if (matrix) return *matrix;
  glm::dmat4 result = glm::mat4_cast(rotation);
  for (int i = 0; i < 3; ++i)
    result[i] *= scale[i];
  result[3] = glm::dvec4(translation, 1.0);
  return result;
}

namespace {

/// An animated node has no matrix; if it has one all the same, the pose replaces it.
glm::dmat4 posed(Transform transform, const NodePose& pose) {
  if (!pose.translation && !pose.rotation && !pose.scale) return transform.to_matrix();
  transform.matrix.reset();
  if (pose.translation) transform.translation = *pose.translation;
  if (pose.rotation) transform.rotation = *pose.rotation;
  if (pose.scale) transform.scale = *pose.scale;
  return transform.to_matrix();
}

}  // namespace

std::vector<double> target_weights(const Scene& scene, const Placement& placement,
                                   const NodePoses& poses) {
  if (placement.node == kNone) return {};
  const auto pose = poses.find(placement.node);
  if (pose != poses.end() && pose->second.weights) return *pose->second.weights;
  return scene.nodes[placement.node].weights;
}

std::vector<glm::dmat4> node_transforms(const Scene& scene, const NodePoses& poses) {
  std::vector<glm::dmat4> transforms;
  transforms.reserve(scene.nodes.size());
  for (const Node& node : scene.nodes)
    transforms.push_back(node.to_parent.to_matrix());
  for (const auto& [node, pose] : poses) {
    if (node < transforms.size()) transforms[node] = posed(scene.nodes[node].to_parent, pose);
  }
  for (const std::uint32_t node : scene.order) {
    const std::uint32_t parent = scene.nodes[node].parent;
    if (parent != kNone) transforms[node] = transforms[parent] * transforms[node];
  }
  return transforms;
}

glm::dmat4 first_transform(const Scene& scene, const Placement& placement,
                           const std::vector<glm::dmat4>& nodes) {
  if (placement.node == kNone) return placement.instance;
  const Node& node = scene.nodes[placement.node];
  if (node.skin == kNone || scene.skins[node.skin].joints.empty())
    return nodes[placement.node] * placement.instance;
  const Skin& skin = scene.skins[node.skin];
  return nodes[skin.joints.front()] * skin.inverse_binds.front() * placement.instance;
}

std::vector<glm::dmat4> mesh_transforms(const Scene& scene, const Placement& placement,
                                        const std::vector<glm::dmat4>& nodes) {
  if (placement.node == kNone) return {first_transform(scene, placement, nodes)};
  const Node& node = scene.nodes[placement.node];
  // The transform of the node of a skinned mesh does not count.
  const Skin* const skin = node.skin == kNone ? nullptr : &scene.skins[node.skin];
  if (skin == nullptr || skin->joints.empty()) return {first_transform(scene, placement, nodes)};
  std::vector<glm::dmat4> matrices;
  for (std::size_t j = 0; j < skin->joints.size(); ++j) {
    matrices.push_back(nodes[skin->joints[j]] * skin->inverse_binds[j] * placement.instance);
  }
  return matrices;
}

std::vector<glm::dmat4> palette(const Scene& scene, const SceneMesh& mesh,
                                const Placement& placement, const std::vector<glm::dmat4>& nodes) {
  const glm::dmat4 to_model = glm::translate(glm::dmat4(1.0), -scene.origin);
  const glm::dmat4 from_model = glm::inverse(to_model * mesh.to_scene);
  std::vector<glm::dmat4> matrices = mesh_transforms(scene, placement, nodes);
  for (glm::dmat4& matrix : matrices) {
    // Without rounding where nothing moves.
    matrix = matrix == mesh.to_scene ? glm::dmat4(1.0) : to_model * matrix * from_model;
  }
  return matrices;
}

}  // namespace mesher::scene
