#include "engine/render/draw_order.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace mesher::render {
namespace {

/// A material, and whether its faces blend. Those that do are told apart by their group.
struct BatchKey {
  bool blends = false;
  std::uint32_t material = 0;
  std::uint32_t group = 0;
  friend auto operator<=>(const BatchKey&, const BatchKey&) = default;
};

BatchKey key_of(const FaceGroup& group, std::uint32_t index, const Materials* materials) {
  const std::size_t count = materials == nullptr ? 0 : materials->materials.size();
  if (group.material >= count) return {.material = static_cast<std::uint32_t>(count)};
  const bool blends = materials->materials[group.material].alpha == AlphaMode::blend;
  return {blends, group.material, blends ? index : 0};
}

glm::vec3 center_of(const Mesh& mesh, std::span<const std::uint32_t> faces) {
  glm::dvec3 sum(0.0);
  for (const std::uint32_t face : faces) {
    for (std::uint32_t corner = 0; corner < 3; ++corner)
      sum += glm::dvec3(mesh.position(mesh.origin(Halfedge(3 * face + corner))));
  }
  return sum / (3.0 * static_cast<double>(std::max<std::size_t>(faces.size(), 1)));
}

/// Sorts the faces by the batches of their groups. Sets the first face of each batch.
Array<std::uint32_t> sorted_faces(std::span<const std::uint32_t> group_of,
                                  const std::vector<std::uint32_t>& batch_of,
                                  std::vector<Batch>& batches) {
  for (const std::uint32_t group : group_of)
    ++batches[batch_of[group]].count;
  std::uint32_t first = 0;
  std::vector<std::uint32_t> next;
  for (Batch& batch : batches) {
    batch.first = first;
    next.push_back(first);
    first += batch.count;
  }
  Array<std::uint32_t> faces(group_of.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    faces[next[batch_of[group_of[f]]]++] = f;
  return faces;
}

}  // namespace

DrawOrder order_of_faces(std::uint32_t faces, const Attributes& attributes,
                         const Materials* materials) {
  // Without groups, the faces have no material.
  const std::vector<FaceGroup> none(1);
  const bool is_grouped = !attributes.group.empty();
  const std::vector<FaceGroup>& groups = is_grouped ? attributes.groups : none;
  std::map<BatchKey, std::uint32_t> batch_of_key;
  for (std::uint32_t i = 0; i < groups.size(); ++i)
    batch_of_key.emplace(key_of(groups[i], i, materials), 0);
  DrawOrder order;
  for (auto& [key, batch] : batch_of_key) {
    batch = static_cast<std::uint32_t>(order.batches.size());
    order.batches.push_back({.material = key.material, .blends = key.blends});
  }
  if (!is_grouped || order.batches.size() == 1) {
    order.batches.resize(1);
    order.batches.front().count = faces;
    return order;
  }
  std::vector<std::uint32_t> batch_of;
  for (std::uint32_t i = 0; i < groups.size(); ++i)
    batch_of.push_back(batch_of_key.at(key_of(groups[i], i, materials)));
  order.faces = sorted_faces(std::span(attributes.group).first(faces), batch_of, order.batches);
  return order;
}

std::vector<Batch> batches_of_level(const DrawOrder& order, const Mesh& level) {
  std::vector<Batch> batches;
  for (Batch batch : order.batches) {
    std::span<const std::uint32_t> faces;
    if (order.faces.empty()) {
      batch.count = std::min(batch.count, level.face_count());
    } else {
      const auto all = std::span(order.faces).subspan(batch.first, batch.count);
      const auto end = std::ranges::lower_bound(all, level.face_count());
      batch.count = static_cast<std::uint32_t>(end - all.begin());
      faces = all.first(batch.count);
    }
    if (batch.count == 0 && !order.faces.empty()) continue;
    if (batch.blends && !faces.empty()) batch.center = center_of(level, faces);
    batches.push_back(batch);
  }
  return batches;
}

DrawOrder draw_order(const Mesh& mesh, const Attributes& attributes, const Materials* materials) {
  DrawOrder order = order_of_faces(mesh.face_count(), attributes, materials);
  order.batches = batches_of_level(order, mesh);
  return order;
}

}  // namespace mesher::render
