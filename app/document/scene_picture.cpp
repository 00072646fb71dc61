#include "app/document/scene_picture.h"

#include <algorithm>
#include <utility>

#include "engine/scene/morph.h"

namespace mesher::app {
namespace {

bool has_targets(const Attributes& attributes) {
  return std::ranges::any_of(attributes.layers, [](const AttributeLayer& layer) {
    return layer.type().kind == AttributeKind::delta;
  });
}

std::vector<Box> boxes_of(const scene::Copies& copies) {
  std::vector<Box> boxes(copies.list.size());
  for (std::uint32_t v = 0; v < copies.of_vertex.size(); ++v) {
    if (copies.of_vertex[v] != kNone)
      extend(boxes[copies.of_vertex[v]], copies.shape.mesh.position(Vertex(v)));
  }
  return boxes;
}

}  // namespace

ScenePicture::ScenePicture(const Document& document)
    : shown_(scene::copies_of(document.model.mesh, document.model.attributes, *document.model.scene,
                              document.hidden)) {
  if (has_targets(shown_.shape.attributes)) still_ = shown_;
  boxes_ = boxes_of(shown_);
  std::uint32_t first = 0;
  for (const auto& own : palettes_of(shown_, *document.model.scene)) {
    first_matrix_.push_back(first);
    first += static_cast<std::uint32_t>(own.size());
  }
  first_matrix_.push_back(first);
  find_influences();
}

void ScenePicture::find_influences() {
  const scene::Influences joints = scene::influences_of(shown_.shape);
  const std::size_t per_vertex = std::max(joints.per_vertex, 1U);
  influences_.assign(per_vertex * shown_.of_vertex.size(), {0, 0.0F});
  for (std::uint32_t v = 0; v < shown_.of_vertex.size(); ++v) {
    const std::uint32_t copy = shown_.of_vertex[v];
    if (copy == kNone) continue;
    const std::uint32_t first = first_matrix_[copy];
    const std::uint32_t count = first_matrix_[copy + 1] - first;
    const auto own = std::span(influences_).subspan(per_vertex * v, per_vertex);
    own.front() = {first, 1.0F};
    if (count == 1 || joints.per_vertex == 0) continue;
    std::ranges::transform(
        joints.of(Vertex(v)), own.begin(), [&](const scene::Influence& influence) {
          return render::shared::PoseInfluence{
              first + (influence.joint < count ? influence.joint : 0), influence.weight};
        });
  }
}

bool ScenePicture::pose(const Document& document) {
  const scene::Scene& scene = *document.model.scene;
  const scene::NodePoses poses = shown_poses(document);
  const bool is_morphed = morph(target_weights_of(shown_, scene, poses));
  palette_.clear();
  box_ = {};
  std::size_t copy = 0;
  for (const auto& own : palettes_of(shown_, scene, poses)) {
    for (const glm::dmat4& matrix : own) {
      for (int row = 0; row < 3; ++row)
        palette_.emplace_back(matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]);
      extend(box_, boxes_[copy], matrix);
    }
    ++copy;
  }
  return is_morphed;
}

bool ScenePicture::morph(std::vector<std::vector<double>>&& weights) {
  if (still_.list.empty() || weights == weights_) return false;
  weights_ = std::move(weights);
  shown_ = still_;
  add_targets(weights_, shown_);
  boxes_ = boxes_of(shown_);
  return true;
}

render::PoseSource ScenePicture::pose_source() const {
  return {.palette = palette_, .influences = influences_, .box = box_};
}

}  // namespace mesher::app
