#include "engine/mesh/delta.h"

#include <algorithm>
#include <utility>

namespace mesher {
namespace {

/// Bytes per face of the arrays of a mesh, in the order of their members.
constexpr double kArrayWeights[] = {6.0, 12.0, 12.0, 2.0, 12.0, 0.1, 0.1};

void note(ChangeLog& changes, GpuArray array, const ArrayDelta& delta, Direction direction) {
  delta.for_each_written(direction, [&](ChangedRange range) {
    changes.note(array, range.begin, range.end - range.begin);
  });
}

template <class T>
ArrayDelta unchanged(std::span<const T> array) {
  return ArrayDelta::of_elements<T>(array, {});
}

template <class T>
ArrayDelta array_difference(const Array<T>& before, const Array<T>& after, Progress* progress) {
  return {std::span<const T>(before), std::span<const T>(after), progress};
}

bool have_same_types(const std::vector<AttributeLayer>& a, const std::vector<AttributeLayer>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const AttributeLayer& x, const AttributeLayer& y) { return x.type() == y.type(); });
}

}  // namespace

MeshDelta::MeshDelta(const Mesh& before, const Mesh& after, Progress* progress) {
  Stages stages(progress, kArrayWeights);
  const auto compare = [&](auto array) {
    stages.next();
    return ArrayDelta((before.*array)(), (after.*array)(), progress);
  };
  position_ = compare(&Mesh::positions);
  origin_ = compare(&Mesh::origins);
  twin_ = compare(&Mesh::twins);
  outgoing_ = compare(&Mesh::outgoings);
  sharpness_ = compare(&Mesh::sharpnesses);
  vertex_sharpness_ = compare(&Mesh::vertex_sharpnesses);
  bow_tie_copies_ = compare(&Mesh::bow_tie_copies);
}

MeshDelta::MeshDelta(const Mesh& mesh, std::span<const ElementWrite<float>> sharpness)
    : position_(unchanged(mesh.positions())),
      origin_(unchanged(mesh.origins())),
      twin_(unchanged(mesh.twins())),
      outgoing_(unchanged(mesh.outgoings())),
      sharpness_(ArrayDelta::of_elements(mesh.sharpnesses(), sharpness)),
      vertex_sharpness_(unchanged(mesh.vertex_sharpnesses())),
      bow_tie_copies_(unchanged(mesh.bow_tie_copies())) {}

bool MeshDelta::is_empty() const {
  return position_.is_empty() && origin_.is_empty() && twin_.is_empty() && outgoing_.is_empty() &&
         sharpness_.is_empty() && vertex_sharpness_.is_empty() && bow_tie_copies_.is_empty();
}

std::size_t MeshDelta::memory_bytes() const {
  return position_.memory_bytes() + origin_.memory_bytes() + twin_.memory_bytes() +
         outgoing_.memory_bytes() + sharpness_.memory_bytes() + vertex_sharpness_.memory_bytes() +
         bow_tie_copies_.memory_bytes();
}

void MeshDelta::make_room(Mesh& mesh) const {
  position_.make_room(mesh.position_);
  origin_.make_room(mesh.origin_);
  twin_.make_room(mesh.twin_);
  outgoing_.make_room(mesh.outgoing_);
  sharpness_.make_room(mesh.sharpness_);
  vertex_sharpness_.make_room(mesh.vertex_sharpness_);
  bow_tie_copies_.make_room(mesh.bow_tie_copies_);
}

// Everything that can fail comes first: a half-written mesh is invalid.
void MeshDelta::write(Mesh& mesh, Direction direction) const {
  make_room(mesh);
  position_.write(mesh.position_, direction);
  origin_.write(mesh.origin_, direction);
  twin_.write(mesh.twin_, direction);
  outgoing_.write(mesh.outgoing_, direction);
  sharpness_.write(mesh.sharpness_, direction);
  vertex_sharpness_.write(mesh.vertex_sharpness_, direction);
  bow_tie_copies_.write(mesh.bow_tie_copies_, direction);
  ChangeLog& changes = mesh.changes_;
  note(changes, GpuArray::position, position_, direction);
  note(changes, GpuArray::origin, origin_, direction);
  note(changes, GpuArray::edge_class, twin_, direction);
  note(changes, GpuArray::edge_class, sharpness_, direction);
  // If a vertex has lost its last face, no other change tells that its normal is gone.
  outgoing_.for_each_written(direction, [&](ChangedRange range) {
    for (std::uint32_t v = range.begin; v < range.end; ++v) {
      if (!mesh.outgoing_[v].is_valid()) changes.note(GpuArray::position, v);
    }
  });
}

MeshDelta difference(const Mesh& before, const Mesh& after, Progress* progress) {
  return {before, after, progress};
}

MeshDelta sharpness_difference(const Mesh& mesh, std::span<const EdgeSharpness> wanted) {
  std::vector<ElementWrite<float>> writes;
  writes.reserve(2 * wanted.size());
  for (const auto& [edge, sharpness] : wanted) {
    MESHER_ASSERT(sharpness >= 0.0F);
    const Halfedge h = Mesh::halfedge(edge);
    writes.push_back({h.index(), sharpness});
    if (!mesh.is_boundary(h)) writes.push_back({mesh.twin(h).index(), sharpness});
  }
  std::sort(writes.begin(), writes.end(),
            [](const auto& a, const auto& b) { return a.index < b.index; });
  return {mesh, writes};
}

void make_room(Mesh& mesh, const MeshDelta& delta) {
  delta.make_room(mesh);
}

void apply(Mesh& mesh, const MeshDelta& delta) {
  delta.write(mesh, Direction::forward);
}

void revert(Mesh& mesh, const MeshDelta& delta) {
  delta.write(mesh, Direction::back);
}

AttributesDelta::AttributesDelta(const Attributes& before, const Attributes& after,
                                 Progress* progress) {
  Stages stages(progress, {0.3, 0.7});
  stages.next();
  corner_wedge_ = array_difference(before.corner_wedge, after.corner_wedge, progress);
  further_ = array_difference(before.further, after.further, progress);
  group_ = array_difference(before.group, after.group, progress);
  stages.next();
  if (have_same_types(before.layers, after.layers)) {
    for (std::size_t i = 0; i < before.layers.size(); ++i)
      layers_.push_back(ArrayDelta::of_bytes(before.layers[i].bytes(), after.layers[i].bytes(),
                                             before.layers[i].type().value_bytes(), progress));
  } else {
    old_layers_ = before.layers;
    new_layers_ = after.layers;
  }
  if (before.groups == after.groups) return;
  old_groups_ = before.groups;
  new_groups_ = after.groups;
}

bool AttributesDelta::is_empty() const {
  return corner_wedge_.is_empty() && further_.is_empty() && keeps_types() &&
         std::all_of(layers_.begin(), layers_.end(),
                     [](const ArrayDelta& layer) { return layer.is_empty(); }) &&
         group_.is_empty() && old_groups_ == new_groups_;
}

std::size_t AttributesDelta::memory_bytes() const {
  std::size_t bytes =
      corner_wedge_.memory_bytes() + further_.memory_bytes() + group_.memory_bytes();
  for (const ArrayDelta& layer : layers_)
    bytes += layer.memory_bytes();
  for (const auto* layers : {&old_layers_, &new_layers_}) {
    for (const AttributeLayer& layer : *layers)
      bytes += layer.bytes().size();
  }
  return bytes;
}

void AttributesDelta::make_room(Attributes& attributes) const {
  corner_wedge_.make_room(attributes.corner_wedge);
  further_.make_room(attributes.further);
  for (std::size_t i = 0; i < layers_.size(); ++i)
    layers_[i].make_room_for_bytes(attributes.layers[i].bytes());
  group_.make_room(attributes.group);
}

// Everything that can fail comes first.
void AttributesDelta::write(Attributes& attributes, Direction direction) const {
  const bool is_forward = direction == Direction::forward;
  std::vector<FaceGroup> groups = is_forward ? new_groups_ : old_groups_;
  std::vector<AttributeLayer> layers = is_forward ? new_layers_ : old_layers_;
  make_room(attributes);
  corner_wedge_.write(attributes.corner_wedge, direction);
  further_.write(attributes.further, direction);
  for (std::size_t i = 0; i < layers_.size(); ++i)
    layers_[i].write_to_bytes(attributes.layers[i].bytes(), direction);
  if (!keeps_types()) attributes.layers = std::move(layers);
  group_.write(attributes.group, direction);
  if (old_groups_ != new_groups_) attributes.groups = std::move(groups);
}

AttributesDelta difference(const Attributes& before, const Attributes& after, Progress* progress) {
  return {before, after, progress};
}

void make_room(Attributes& attributes, const AttributesDelta& delta) {
  delta.make_room(attributes);
}

void apply(Attributes& attributes, const AttributesDelta& delta) {
  delta.write(attributes, Direction::forward);
}

void revert(Attributes& attributes, const AttributesDelta& delta) {
  delta.write(attributes, Direction::back);
}

}  // namespace mesher
