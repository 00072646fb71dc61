#include "engine/mesh/mesh.h"

#include "engine/mesh/circulators.h"

namespace mesher {

std::uint32_t Mesh::valence(Vertex v) const {
  std::uint32_t count = 0;
  for ([[maybe_unused]] const Edge e : edges_around(*this, v))
    ++count;
  return count;
}

Halfedge Mesh::find_halfedge(Vertex a, Vertex b) const {
  for (const Halfedge h : halfedges_around(*this, a)) {
    if (target(h) == b) return h;
  }
  return {};
}

Edge Mesh::find_edge(Vertex a, Vertex b) const {
  Halfedge h = find_halfedge(a, b);
  if (!h.is_valid()) h = find_halfedge(b, a);
  return h.is_valid() ? edge(h) : Edge{};
}

std::uint32_t Mesh::count_edges() const {
  std::uint32_t boundary = 0;
  for (const Halfedge t : twin_)
    boundary += t.is_valid() ? 0 : 1;
  return (halfedge_count() - boundary) / 2 + boundary;
}

std::size_t Mesh::memory_bytes() const {
  const auto bytes = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  return bytes(position_) + bytes(origin_) + bytes(twin_) + bytes(outgoing_) + bytes(sharpness_) +
         bytes(vertex_sharpness_) + bytes(bow_tie_copies_);
}

void Mesh::set_position(Vertex v, const glm::vec3& p) {
  MESHER_ASSERT(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  position_[v.index()] = p;
  changes_.note(GpuArray::position, v.index());
}

void Mesh::set_sharpness(Edge e, float sharpness) {
  MESHER_ASSERT(sharpness >= 0.0F);
  const Halfedge h = halfedge(e);
  for (const Halfedge side : {h, twin(h)}) {
    if (!side.is_valid()) continue;
    sharpness_[side.index()] = sharpness;
    changes_.note(GpuArray::edge_class, side.index());
  }
}

void Mesh::set_sharpness(Vertex v, float sharpness) {
  MESHER_ASSERT(sharpness >= 0.0F);
  if (vertex_sharpness_.empty()) vertex_sharpness_.assign(vertex_count(), 0.0F);
  vertex_sharpness_[v.index()] = sharpness;
}

Mesh MeshArrays::finish() && {
  Mesh mesh;
  mesh.position_ = std::move(position);
  mesh.origin_ = std::move(origin);
  mesh.twin_ = std::move(twin);
  mesh.outgoing_ = std::move(outgoing);
  mesh.sharpness_ = std::move(sharpness);
  mesh.vertex_sharpness_ = std::move(vertex_sharpness);
  mesh.bow_tie_copies_ = std::move(bow_tie_copies);
  mesh.changes_.note_all();
  return mesh;
}

MeshArrays MeshArrays::take(Mesh&& mesh) {
  return {std::move(mesh.position_),      std::move(mesh.origin_),
          std::move(mesh.twin_),          std::move(mesh.outgoing_),
          std::move(mesh.sharpness_),     std::move(mesh.vertex_sharpness_),
          std::move(mesh.bow_tie_copies_)};
}

MeshArrays::InPlace MeshArrays::open(Mesh& mesh) {
  return {mesh.position_,  mesh.origin_,           mesh.twin_,          mesh.outgoing_,
          mesh.sharpness_, mesh.vertex_sharpness_, mesh.bow_tie_copies_};
}

}  // namespace mesher
