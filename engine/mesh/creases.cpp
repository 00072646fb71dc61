#include "engine/mesh/creases.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"

namespace mesher {
namespace {

glm::dvec3 area_normal(const Mesh& mesh, Face f) {
  const glm::dvec3 a = mesh.position(mesh.origin(Mesh::halfedge(f, 0)));
  const glm::dvec3 b = mesh.position(mesh.origin(Mesh::halfedge(f, 1)));
  const glm::dvec3 c = mesh.position(mesh.origin(Mesh::halfedge(f, 2)));
  return glm::cross(b - a, c - a);
}

/// Returns the edges that satisfy a condition, ascending.
template <class Condition>
std::vector<Edge> edges_where(const Mesh& mesh, const Condition& is_wanted) {
  constexpr std::size_t kChunk = 1U << 16;
  std::vector<std::vector<Edge>> parts(chunk_count(mesh.halfedge_count(), kChunk));
  parallel_chunks(mesh.halfedge_count(), kChunk, [&](std::size_t chunk, IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Edge e(static_cast<std::uint32_t>(i));
      if (mesh.edge(Mesh::halfedge(e)) == e && is_wanted(e)) parts[chunk].push_back(e);
    }
  });
  std::vector<Edge> all;
  for (const std::vector<Edge>& part : parts)
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

bool is_sharp(const Mesh& mesh, Edge e) {
  return mesh.sharpness(Mesh::halfedge(e)) > 0.0F;
}

Vertex other_end(const Mesh& mesh, Edge e, Vertex v) {
  const Halfedge h = Mesh::halfedge(e);
  return mesh.origin(h) == v ? mesh.target(h) : mesh.origin(h);
}

/// Returns the unit vector along an edge, away from its end `v`.
glm::dvec3 direction_from(const Mesh& mesh, Edge e, Vertex v) {
  const glm::dvec3 along =
      glm::dvec3(mesh.position(other_end(mesh, e, v))) - glm::dvec3(mesh.position(v));
  const double length = glm::length(along);
  return length > 0.0 ? along / length : glm::dvec3(0.0);
}

/// Returns the other sharp edge at `v` if there is exactly one.
Edge next_of_crease(const Mesh& mesh, Edge e, Vertex v) {
  Edge next;
  for (const Edge other : edges_around(mesh, v)) {
    if (other == e || !is_sharp(mesh, other)) continue;
    if (next.is_valid()) return {};  // a junction
    next = other;
  }
  return next;
}

/// Returns the smooth edge at `v` with the least turn, if its cosine exceeds `least_cosine`; of
/// equal turns, the lower edge.
Edge straightest(const Mesh& mesh, Edge e, Vertex v, double least_cosine) {
  const glm::dvec3 onward = -direction_from(mesh, e, v);
  Edge next;
  double best = least_cosine;
  for (const Edge other : edges_around(mesh, v)) {
    if (other == e || is_sharp(mesh, other)) continue;
    const double cosine = glm::dot(onward, direction_from(mesh, other, v));
    if (cosine > best || (cosine == best && next.is_valid() && other < next)) {
      best = cosine;
      next = other;
    }
  }
  return next;
}

Edge next_in_chain(const Mesh& mesh, Edge e, Vertex v, double least_cosine) {
  if (mesh.is_boundary(v)) return {};
  if (is_sharp(mesh, e)) return next_of_crease(mesh, e, v);
  const Edge next = straightest(mesh, e, v, least_cosine);
  const bool is_mutual = next.is_valid() && straightest(mesh, next, v, least_cosine) == e;
  return is_mutual ? next : Edge{};
}

}  // namespace

float dihedral_angle_rad(const Mesh& mesh, Edge e) {
  if (mesh.is_boundary(e)) return 0.0F;
  const Halfedge h = Mesh::halfedge(e);
  const glm::dvec3 a = area_normal(mesh, Mesh::face(h));
  const glm::dvec3 b = area_normal(mesh, Mesh::face(mesh.twin(h)));
  return static_cast<float>(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

std::uint32_t tag_creases_by_angle(Mesh& mesh, float angle_rad) {
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Edge e = mesh.edge(Halfedge(i));
    if (e.index() != i || mesh.is_boundary(e)) continue;
    if (dihedral_angle_rad(mesh, e) <= angle_rad) continue;
    mesh.set_sharpness(e, kInfinitelySharp);
    ++count;
  }
  return count;
}

std::vector<Edge> untagged_edges_beyond(const Mesh& mesh, float angle_rad) {
  return edges_where(mesh, [&](Edge e) {
    return !mesh.is_boundary(e) && mesh.sharpness(Mesh::halfedge(e)) < kInfinitelySharp &&
           dihedral_angle_rad(mesh, e) > angle_rad;
  });
}

std::vector<Edge> sharp_edges(const Mesh& mesh) {
  return edges_where(mesh, [&](Edge e) { return is_sharp(mesh, e); });
}

// Continuation is mutual, so edges form lines and loops, and only a loop returns to its start.
std::vector<Edge> crease_chain(const Mesh& mesh, Edge start, float turn_rad) {
  std::vector<Edge> chain{start};
  if (mesh.is_boundary(start)) return chain;
  const double least_cosine = std::cos(static_cast<double>(turn_rad));
  const auto extend = [&](Vertex v) {
    Edge e = start;
    while ((e = next_in_chain(mesh, e, v, least_cosine)).is_valid() && e != start) {
      chain.push_back(e);
      v = other_end(mesh, e, v);
    }
    return e == start;
  };
  const Halfedge h = Mesh::halfedge(start);
  const bool is_loop = extend(mesh.origin(h));
  std::reverse(chain.begin(), chain.end());
  if (!is_loop) extend(mesh.target(h));
  return chain;
}

}  // namespace mesher
