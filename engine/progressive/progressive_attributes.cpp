#include "engine/progressive/progressive_attributes.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

#include "engine/mesh/wedges.h"

namespace mesher::progressive {
namespace {

AttributeStream face_normals(const Mesh& mesh, const AttributeType& type) {
  AttributeStream stream;
  stream.index.resize(mesh.halfedge_count());
  AttributeLayer& layer = stream.layers.emplace_back(type, mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    std::array<glm::dvec3, 3> p;
    for (std::uint32_t c = 0; c < 3; ++c) {
      stream.index[3 * std::size_t{f} + c] = f;
      p[c] = glm::dvec3(mesh.position(mesh.origin(Mesh::halfedge(Face(f), c))));
    }
    const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double length = glm::length(normal);
    const glm::dvec3 n = length > 0.0 ? normal / length : normal;
    store(layer, f, {n.x, n.y, n.z, 0.0});
  }
  return stream;
}

}  // namespace

void ProgressiveAttributes::swap(std::uint32_t split) {
  const std::size_t corners = splits_[split].first_corner;
  for (std::size_t i = corners; i < corners + corner_changes(split).size(); ++i)
    std::swap(corner_wedge_[corner_changes_[i].corner.index()], corner_changes_[i].other);
  const std::size_t values = splits_[split].first_value;
  for (std::size_t i = values; i < values + changed_wedges(split).size(); ++i) {
    for (std::size_t k = 0; k < layers_.size(); ++k)
      std::ranges::swap_ranges(layers_[k].value(changed_wedges_[i].index()), others_[k].value(i));
  }
}

void ProgressiveAttributes::go_to(std::uint32_t level) {
  MESHER_ASSERT(level <= split_count());
  for (; level_ < level; ++level_)
    swap(level_);
  for (; level_ > level; --level_)
    swap(level_ - 1);
}

std::vector<AttributeStream> ProgressiveAttributes::streams(const Mesh& mesh) const {
  std::vector<AttributeStream> streams(1);
  AttributeStream& by_wedge = streams.front();
  by_wedge.index.resize(mesh.halfedge_count());
  std::transform(corner_wedge_.begin(), corner_wedge_.begin() + mesh.halfedge_count(),
                 by_wedge.index.begin(), [](Wedge w) { return w.index(); });
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    if (is_faceted_[k] != 0 && level_ < split_count()) {
      streams.push_back(face_normals(mesh, layers_[k].type()));
      continue;
    }
    AttributeLayer& to =
        streams.front().layers.emplace_back(layers_[k].type(), wedge_count(level_));
    std::copy_n(layers_[k].bytes().begin(), to.bytes().size(), to.bytes().begin());
  }
  if (streams.front().layers.empty()) streams.erase(streams.begin());
  return streams;
}

Attributes ProgressiveAttributes::at_level(const Mesh& mesh, Progress* progress) const {
  Attributes result;
  if (!layers_.empty()) result = make_wedges(mesh, streams(mesh), progress);
  result.groups = groups_;
  if (!group_.empty()) result.group.assign(group_.begin(), group_.begin() + mesh.face_count());
  return result;
}

std::size_t ProgressiveAttributes::memory_bytes() const {
  const auto bytes = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  std::size_t sum = bytes(splits_) + bytes(corner_wedge_) + bytes(corner_changes_) +
                    bytes(changed_wedges_) + bytes(group_);
  for (const auto* layers : {&layers_, &others_}) {
    for (const AttributeLayer& layer : *layers)
      sum += layer.bytes().capacity();
  }
  return sum;
}

}  // namespace mesher::progressive
