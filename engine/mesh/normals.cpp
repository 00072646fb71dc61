#include "engine/mesh/normals.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"
#include "engine/mesh/unit_vector.h"

namespace mesher {
namespace {

constexpr std::size_t kNormalsGrain = 4096;
constexpr float kPi = 3.14159265F;

glm::dvec3 cross_at(const Mesh& mesh, Halfedge h) {
  const glm::dvec3 at = mesh.position(mesh.origin(h));
  return glm::cross(glm::dvec3(mesh.position(mesh.target(h))) - at,
                    glm::dvec3(mesh.position(mesh.origin(Mesh::prev(h)))) - at);
}

double angle_at(const Mesh& mesh, Halfedge h) {
  const glm::dvec3 at = mesh.position(mesh.origin(h));
  const glm::dvec3 a = glm::dvec3(mesh.position(mesh.target(h))) - at;
  const glm::dvec3 b = glm::dvec3(mesh.position(mesh.origin(Mesh::prev(h)))) - at;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Returns a corner's contribution to its vertex's normal, given the cross product of its face.
glm::dvec3 weighted_normal(const Mesh& mesh, Halfedge h, const glm::dvec3& cross,
                           NormalWeight weight) {
  switch (weight) {
    case NormalWeight::area:
      return cross;
    case NormalWeight::angle:
      return unit_or_zero(cross) * angle_at(mesh, h);
    case NormalWeight::uniform:
      break;
  }
  return unit_or_zero(cross);
}

/// The corners around one vertex, in order, and the edges at which its normals are split.
class CornerFan {
 public:
  void gather(const Mesh& mesh, Vertex v, const CornerNormalOptions& options) {
    corners_.clear();
    for (const Halfedge h : halfedges_around(mesh, v)) {
      const glm::dvec3 cross = cross_at(mesh, h);
      corners_.push_back(
          {h, unit_or_zero(cross), weighted_normal(mesh, h, cross, options.weight), false});
    }
    const double cos_limit = std::cos(static_cast<double>(options.crease_angle_rad));
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      corners_[i].starts_run = is_split_before(mesh, i, options, cos_limit);
    }
  }

  void write(Array<glm::vec3>& normals) const {
    const std::size_t n = corners_.size();
    std::size_t first = 0;
    while (first < n && !corners_[first].starts_run)
      ++first;
    if (first == n) first = 0;  // no split: one run all around
    for (std::size_t done = 0; done < n;) {
      const std::size_t length = run_length(first, n - done);
      const glm::vec3 normal = run_normal(first, length);
      for (std::size_t i = 0; i < length; ++i) {
        normals[corners_[(first + i) % n].h.index()] = normal;
      }
      first = (first + length) % n;
      done += length;
    }
  }

 private:
  struct Corner {
    Halfedge h;
    glm::dvec3 unit;
    glm::dvec3 weighted;
    bool starts_run;
  };

  // Half-edge i runs along the edge between corner i-1 and corner i.
  bool is_split_before(const Mesh& mesh, std::size_t i, const CornerNormalOptions& options,
                       double cos_limit) const {
    const Halfedge h = corners_[i].h;
    if (mesh.is_boundary(h)) return true;
    if (options.split_at_creases && mesh.sharpness(h) > 0.0F) return true;
    if (!options.splits.empty() && options.splits[h.index()] != 0) return true;
    const glm::dvec3& before = corners_[i == 0 ? corners_.size() - 1 : i - 1].unit;
    // A face without area has no angle to its neighbors: a sliver must not split the shading.
    if (before == glm::dvec3(0.0) || corners_[i].unit == glm::dvec3(0.0)) return false;
    return options.crease_angle_rad < kPi && glm::dot(before, corners_[i].unit) < cos_limit;
  }

  std::size_t run_length(std::size_t first, std::size_t most) const {
    std::size_t length = 1;
    while (length < most && !corners_[(first + length) % corners_.size()].starts_run)
      ++length;
    return length;
  }

  glm::vec3 run_normal(std::size_t first, std::size_t length) const {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < length; ++i)
      sum += corners_[(first + i) % corners_.size()].weighted;
    return glm::vec3(unit_or_zero(sum));
  }

  std::vector<Corner> corners_;
};

}  // namespace

glm::vec3 face_normal(const Mesh& mesh, Face f) {
  return glm::vec3(unit_or_zero(cross_at(mesh, Mesh::halfedge(f))));
}

Array<glm::vec3> face_normals(const Mesh& mesh) {
  Array<glm::vec3> normals(mesh.face_count());
  parallel_for(mesh.face_count(), kNormalsGrain, [&](IndexRange range) {
    for (std::size_t f = range.begin; f < range.end; ++f) {
      normals[f] = face_normal(mesh, Face(static_cast<std::uint32_t>(f)));
    }
  });
  return normals;
}

glm::vec3 vertex_normal(const Mesh& mesh, Vertex v, NormalWeight weight) {
  glm::dvec3 sum(0.0);
  for (const Halfedge h : halfedges_around(mesh, v)) {
    sum += weighted_normal(mesh, h, cross_at(mesh, h), weight);
  }
  return glm::vec3(unit_or_zero(sum));
}

Array<glm::vec3> vertex_normals(const Mesh& mesh, NormalWeight weight, Progress* progress) {
  // If unit face normals are needed, compute each once instead of once per corner.
  const bool takes_units = weight != NormalWeight::area;
  const Array<glm::vec3> unit = takes_units ? face_normals(mesh) : Array<glm::vec3>{};
  Array<glm::vec3> normals(mesh.vertex_count());
  parallel_chunks(mesh.vertex_count(), kNormalsGrain, progress, [&](std::size_t, IndexRange range) {
    for (std::size_t v = range.begin; v < range.end; ++v) {
      glm::dvec3 sum(0.0);
      for (const Halfedge h : halfedges_around(mesh, Vertex(static_cast<std::uint32_t>(v)))) {
        if (takes_units) {
          const double share = weight == NormalWeight::angle ? angle_at(mesh, h) : 1.0;
          sum += share * glm::dvec3(unit[Mesh::face(h).index()]);
        } else {
          sum += cross_at(mesh, h);
        }
      }
      normals[v] = glm::vec3(unit_or_zero(sum));
    }
  });
  return normals;
}

Array<glm::vec3> corner_normals(const Mesh& mesh, const CornerNormalOptions& options) {
  Array<glm::vec3> normals(mesh.halfedge_count());
  parallel_for(mesh.vertex_count(), kNormalsGrain, [&](IndexRange range) {
    CornerFan fan;
    for (std::size_t v = range.begin; v < range.end; ++v) {
      fan.gather(mesh, Vertex(static_cast<std::uint32_t>(v)), options);
      fan.write(normals);
    }
  });
  return normals;
}

void update_corner_normals(const Mesh& mesh, Vertex v, const CornerNormalOptions& options,
                           Array<glm::vec3>& normals) {
  MESHER_ASSERT(normals.size() == mesh.halfedge_count());
  CornerFan fan;
  fan.gather(mesh, v, options);
  fan.write(normals);
}

}  // namespace mesher
