#include "engine/simplify/face_tree.h"

#include <bit>

#include "engine/simplify/territory.h"

namespace mesher::simplify {

void FaceTree::build(const Surface& surface, std::vector<Face> faces) {
  faces_ = std::move(faces);
  boxes_.clear();
  if (faces_.empty()) return;
  boxes_.reserve(faces_.size());
  for (const Face f : faces_) {
    slot_of_[f.index()] = static_cast<std::uint32_t>(boxes_.size());
    boxes_.emplace_back(face_box(surface.mesh(), f));
  }
  const std::size_t leaves = (faces_.size() + kLeafFaces - 1) / kLeafFaces;
  first_leaf_ = static_cast<std::uint32_t>(std::bit_ceil(leaves));
  constexpr float kFar = std::numeric_limits<float>::infinity();
  nodes_.assign(2 * std::size_t{first_leaf_}, LaneBox({glm::vec3(kFar), glm::vec3(-kFar)}));
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    LaneBox& leaf = nodes_[first_leaf_ + i / kLeafFaces];
    leaf = join(leaf, boxes_[i]);
  }
  for (std::size_t i = first_leaf_ - 1; i > 0; --i)
    nodes_[i] = join(nodes_[2 * i], nodes_[2 * i + 1]);
}

void FaceTree::move(Face f, const LaneBox& box) {
  const std::size_t slot = slot_of_[f.index()];
  boxes_[slot] = box;
  for (std::size_t i = first_leaf_ + slot / kLeafFaces; i > 0; i /= 2) {
    if (contains(nodes_[i], box)) return;
    nodes_[i] = join(nodes_[i], box);
  }
}

}  // namespace mesher::simplify
