#include "engine/simplify/face_tree.h"

#include "engine/simplify/territory.h"

namespace mesher {

void FaceTree::build(const Surface& surface, std::vector<Face> faces) {
  faces_ = std::move(faces);
  boxes_.clear();
  levels_.clear();
  if (faces_.empty()) return;
  boxes_.reserve(faces_.size());
  for (const Face f : faces_) {
    place_of_[f.index()] = static_cast<std::uint32_t>(boxes_.size());
    boxes_.emplace_back(face_box(surface.mesh(), f));
  }
  std::size_t children = kLeafFaces;
  const std::vector<LaneBox>* below = &boxes_;
  do {
    std::vector<LaneBox> level((below->size() + children - 1) / children);
    for (std::size_t i = 0; i < level.size(); ++i) {
      const std::size_t end = std::min(children * (i + 1), below->size());
      level[i] = (*below)[children * i];
      for (std::size_t k = children * i + 1; k < end; ++k)
        level[i] = join(level[i], (*below)[k]);
    }
    levels_.push_back(std::move(level));
    below = &levels_.back();
    children = 2;
  } while (below->size() > 1);
}

void FaceTree::move(Face f, const LaneBox& box) {
  std::size_t index = place_of_[f.index()];
  boxes_[index] = box;
  index /= kLeafFaces;
  for (std::vector<LaneBox>& level : levels_) {
    LaneBox& node = level[index];
    if (contains(node, box)) return;
    node = join(node, box);
    index /= 2;
  }
}

}  // namespace mesher
