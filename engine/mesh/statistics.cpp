#include "engine/mesh/statistics.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "engine/core/array.h"
#include "engine/core/parallel.h"
#include "engine/core/prefetch.h"

namespace mesher {
namespace {

constexpr std::size_t kStatisticsChunk = 1 << 16;
/// Times of measuring faces, finding boundary loops, and finding components: medians of 0.1, 1.4
/// and 13 million faces.
constexpr double kStatisticsWeights[] = {0.34, 0.03, 0.63};

/// Faces and vertices to look ahead. In polygon soup, neighbors lie anywhere in memory.
constexpr std::size_t kNeighborsAhead = 16;

/// Prefetches the twin and the origins of a half-edge.
void prefetch_edge(const Mesh& mesh, Halfedge h) {
  prefetch(&mesh.twins()[h.index()]);
  prefetch(&mesh.origins()[h.index()]);
}

struct Measures {
  double area = 0.0;
  double volume = 0.0;
  std::uint32_t zero_area_faces = 0;
  std::uint32_t boundary_edges = 0;
  std::uint32_t crease_halfedges = 0;

  Measures& operator+=(const Measures& other) {
    area += other.area;
    volume += other.volume;
    zero_area_faces += other.zero_area_faces;
    boundary_edges += other.boundary_edges;
    crease_halfedges += other.crease_halfedges;
    return *this;
  }
};

/// Sums volumes about `center`, so that a model far from the origin keeps its precision.
Measures measure(const Mesh& mesh, IndexRange faces, const glm::dvec3& center) {
  Measures sum;
  const std::span<const Vertex> origins = mesh.origins();
  for (std::size_t f = faces.begin; f < faces.end; ++f) {
    const std::size_t far = std::min(3 * (f + kNeighborsAhead), origins.size() - 3);
    for (std::size_t h = far; h < far + 3; ++h)
      prefetch(&mesh.positions()[origins[h].index()]);
    glm::dvec3 p[3];
    for (std::uint32_t c = 0; c < 3; ++c) {
      const Halfedge h = Mesh::halfedge(Face(static_cast<std::uint32_t>(f)), c);
      p[c] = glm::dvec3(mesh.position(mesh.origin(h))) - center;
      const EdgeClass edge = mesh.edge_class(h);
      sum.boundary_edges += edge == EdgeClass::boundary ? 1 : 0;
      sum.crease_halfedges += edge == EdgeClass::crease ? 1 : 0;
    }
    const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double length = glm::length(cross);
    sum.area += 0.5 * length;
    sum.volume += glm::dot(p[0], glm::cross(p[1], p[2])) / 6.0;
    sum.zero_area_faces += length == 0.0 ? 1 : 0;
  }
  return sum;
}

std::uint32_t count_components(const std::vector<std::uint32_t>& component_of_face) {
  std::uint32_t count = 0;
  for (const std::uint32_t c : component_of_face)
    count = std::max(count, c + 1);
  return count;
}

}  // namespace

double Box::diagonal() const {
  return is_empty() ? 0.0 : glm::length(glm::dvec3(max) - glm::dvec3(min));
}

void extend(Box& box, const Box& by, const glm::dmat4& transform) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p((corner & 1U) != 0 ? by.max.x : by.min.x,
                       (corner & 2U) != 0 ? by.max.y : by.min.y,
                       (corner & 4U) != 0 ? by.max.z : by.min.z, 1.0);
    const glm::vec3 q(transform * p);
    if (is_finite(q)) extend(box, q);
  }
}

Box bounding_box(const Mesh& mesh) {
  const auto positions = mesh.positions();
  if (positions.empty()) return {};
  std::vector<Box> partial(chunk_count(positions.size(), kStatisticsChunk));
  parallel_chunks(positions.size(), kStatisticsChunk, [&](std::size_t i, IndexRange range) {
    Box box{positions[range.begin], positions[range.begin]};
    for (std::size_t v = range.begin; v < range.end; ++v) {
      box.min = glm::min(box.min, positions[v]);
      box.max = glm::max(box.max, positions[v]);
    }
    partial[i] = box;
  });
  Box box = partial.front();
  for (const Box& part : partial) {
    box.min = glm::min(box.min, part.min);
    box.max = glm::max(box.max, part.max);
  }
  return box;
}

// Each boundary vertex has one boundary edge out of it, so the loops are the cycles of "next
// vertex". Following vertices touches less memory per step than following half-edges.
std::uint32_t count_boundary_loops(const Mesh& mesh, Progress* progress) {
  const std::span<const Halfedge> outgoing = mesh.outgoings();
  Array<std::uint32_t> next(outgoing.size());
  ordered_chunks(outgoing.size(), kStatisticsChunk, progress, [&](IndexRange range) {
    for (std::size_t v = range.begin; v < range.end; ++v) {
      const std::size_t far = std::min(v + kNeighborsAhead, outgoing.size() - 1);
      if (outgoing[far].is_valid()) prefetch_edge(mesh, outgoing[far]);
      const Halfedge h = outgoing[v];
      next[v] = h.is_valid() && mesh.is_boundary(h) ? mesh.target(h).index() : kNone;
    }
  });
  std::uint32_t loops = 0;
  for (std::uint32_t start = 0; start < next.size(); ++start) {
    if (next[start] == kNone) continue;
    ++loops;
    for (std::uint32_t v = start; v != kNone;)
      v = std::exchange(next[v], kNone);
  }
  return loops;
}

std::vector<std::uint32_t> face_components(const Mesh& mesh, Progress* progress) {
  std::vector<std::uint32_t> component(mesh.face_count(), kNone);
  std::vector<Face> queue;
  queue.reserve(mesh.face_count());
  const auto prefetch_ahead = [&](std::size_t i) {
    // The twins of a face arrive before the components of its neighbors are prefetched.
    if (i + 2 * kNeighborsAhead < queue.size())
      prefetch_edge(mesh, Mesh::halfedge(queue[i + 2 * kNeighborsAhead], 0));
    if (i + kNeighborsAhead >= queue.size()) return;
    for (std::uint32_t c = 0; c < 3; ++c) {
      const Halfedge t = mesh.twin(Mesh::halfedge(queue[i + kNeighborsAhead], c));
      if (t.is_valid()) prefetch(&component[Mesh::face(t).index()]);
    }
  };
  std::uint32_t count = 0;
  for (std::uint32_t seed = 0; seed < mesh.face_count(); ++seed) {
    if (component[seed] != kNone) continue;
    std::size_t visited = queue.size();
    component[seed] = count;
    queue.push_back(Face(seed));
    for (; visited < queue.size(); ++visited) {
      if (visited % kStatisticsChunk == 0)
        report(progress, static_cast<float>(visited) / static_cast<float>(mesh.face_count()));
      prefetch_ahead(visited);
      for (std::uint32_t c = 0; c < 3; ++c) {
        const Halfedge t = mesh.twin(Mesh::halfedge(queue[visited], c));
        if (!t.is_valid() || component[Mesh::face(t).index()] != kNone) continue;
        component[Mesh::face(t).index()] = count;
        queue.push_back(Mesh::face(t));
      }
    }
    ++count;
  }
  return component;
}

Statistics statistics(const Mesh& mesh, Progress* progress) {
  Stages stages(progress, kStatisticsWeights);
  stages.next();
  Statistics s;
  s.box = bounding_box(mesh);
  const glm::dvec3 center = s.box.is_empty() ? glm::dvec3(0.0) : s.box.center();
  const auto m =
      parallel_sum<Measures>(mesh.face_count(), kStatisticsChunk, progress,
                             [&](IndexRange range) { return measure(mesh, range, center); });
  s.vertices = mesh.vertex_count();
  s.faces = mesh.face_count();
  s.boundary_edges = m.boundary_edges;
  s.edges = (mesh.halfedge_count() - m.boundary_edges) / 2 + m.boundary_edges;
  s.crease_edges = m.crease_halfedges / 2;
  s.zero_area_faces = m.zero_area_faces;
  s.area = m.area;
  s.volume = m.volume;
  for (const Halfedge h : mesh.outgoings())
    s.isolated_vertices += h.is_valid() ? 0 : 1;
  stages.next();
  s.boundary_loops = count_boundary_loops(mesh, progress);
  stages.next();
  s.components = count_components(face_components(mesh, progress));
  s.euler_characteristic = std::int64_t{s.vertices} - s.isolated_vertices - s.edges + s.faces;
  return s;
}

}  // namespace mesher
