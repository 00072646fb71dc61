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
  for (std::size_t i = corners; i < corners + corner_changes(split).size(); ++i) {
    CornerChange& change = corner_changes_[i];
    std::swap(arrays_.corner_wedge[change.corner.index()], change.other);
    changes_.note(GpuArray::corner_wedge, change.corner.index());
  }
  const std::size_t values = splits_[split].first_value;
  for (std::size_t i = values; i < values + changed_wedges(split).size(); ++i) {
    changes_.note(GpuArray::wedge_value, changed_wedges_[i].index());
    for (std::size_t k = 0; k < arrays_.layers.size(); ++k)
      std::ranges::swap_ranges(arrays_.layers[k].value(changed_wedges_[i].index()),
                               others_[k].value(i));
  }
}

void ProgressiveAttributes::go_to(std::uint32_t level) {
  MESHER_ASSERT(level <= split_count());
  // Beyond about this many ranges, one large copy is cheaper than many small ones.
  constexpr std::uint32_t kFarAway = 4096;
  if (std::max(level, level_) - std::min(level, level_) >= kFarAway) changes_.note_all();
  for (; level_ < level; ++level_)
    swap(level_);
  for (; level_ > level; --level_)
    swap(level_ - 1);
}

std::vector<AttributeStream> ProgressiveAttributes::streams(const Mesh& mesh) const {
  std::vector<AttributeStream> streams(1);
  AttributeStream& by_wedge = streams.front();
  by_wedge.index.resize(mesh.halfedge_count());
  std::transform(arrays_.corner_wedge.begin(), arrays_.corner_wedge.begin() + mesh.halfedge_count(),
                 by_wedge.index.begin(), [](Wedge w) { return w.index(); });
  for (std::size_t k = 0; k < arrays_.layers.size(); ++k) {
    if (is_faceted_[k] != 0 && level_ < split_count()) {
      streams.push_back(face_normals(mesh, arrays_.layers[k].type()));
      continue;
    }
    AttributeLayer& to =
        streams.front().layers.emplace_back(arrays_.layers[k].type(), wedge_count(level_));
    std::copy_n(arrays_.layers[k].bytes().begin(), to.bytes().size(), to.bytes().begin());
  }
  if (streams.front().layers.empty()) streams.erase(streams.begin());
  return streams;
}

Attributes ProgressiveAttributes::at_level(const Mesh& mesh, Progress* progress) const {
  Attributes result;
  if (!arrays_.layers.empty()) result = make_wedges(mesh, streams(mesh), progress);
  result.groups = arrays_.groups;
  if (!arrays_.group.empty())
    result.group.assign(arrays_.group.begin(), arrays_.group.begin() + mesh.face_count());
  return result;
}

std::size_t ProgressiveAttributes::memory_bytes() const {
  const auto bytes = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  std::size_t sum = bytes(splits_) + bytes(arrays_.corner_wedge) + bytes(corner_changes_) +
                    bytes(changed_wedges_) + bytes(arrays_.group);
  for (const auto* layers : {&arrays_.layers, &others_}) {
    for (const AttributeLayer& layer : *layers)
      sum += layer.bytes().capacity();
  }
  return sum;
}

}  // namespace mesher::progressive
