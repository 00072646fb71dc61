#include "engine/simplify/face_tree.h"

#include <glm/common.hpp>

#include "engine/simplify/territory.h"

namespace mesher {
namespace {

Box join(const Box& a, const Box& b) {
  return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

bool contains(const Box& outer, const Box& inner) {
  return glm::min(outer.min, inner.min) == outer.min && glm::max(outer.max, inner.max) == outer.max;
}

}  // namespace

void FaceTree::build(const Surface& surface, std::vector<Face> faces) {
  faces_ = std::move(faces);
  levels_.clear();
  if (faces_.empty()) return;
  levels_.emplace_back((faces_.size() + kLeafFaces - 1) / kLeafFaces);
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const std::size_t leaf = i / kLeafFaces;
    const Box box = face_box(surface.mesh(), faces_[i]);
    Box& sum = levels_.front()[leaf];
    sum = i % kLeafFaces == 0 ? box : join(sum, box);
    leaf_of_[faces_[i].index()] = static_cast<std::uint32_t>(leaf);
  }
  while (levels_.back().size() > 1) {
    const Array<Box>& below = levels_.back();
    Array<Box> level((below.size() + 1) / 2);
    for (std::size_t i = 0; i < level.size(); ++i)
      level[i] = join(below[2 * i], below[std::min(2 * i + 1, below.size() - 1)]);
    levels_.push_back(std::move(level));
  }
}

void FaceTree::grow(Face f, const Box& box) {
  std::size_t index = leaf_of_[f.index()];
  for (Array<Box>& level : levels_) {
    Box& node = level[index];
    if (contains(node, box)) return;
    node = join(node, box);
    index /= 2;
  }
}

}  // namespace mesher
