#include "engine/subdivide/subdivide.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "engine/core/assert.h"
#include "engine/core/face_limit.h"
#include "engine/core/parallel.h"
#include "engine/subdivide/butterfly.h"
#include "engine/subdivide/features.h"
#include "engine/subdivide/limit.h"
#include "engine/subdivide/loop.h"
#include "engine/subdivide/rings.h"
#include "engine/subdivide/sharpness.h"

namespace mesher::subdivide {
namespace {

/// The time of a level is in proportion to its faces: each face is split into four.
constexpr double kFacesPerFace = 4.0;
/// Times of the levels, the limit, and the rest, measured with two levels of 0.1 and 1.4 million
/// faces on two cores. (The limit's normals are three per face.)
constexpr double kStepWeights[] = {0.95, 0.0, 0.05};
constexpr double kLimitWeights[] = {0.18, 0.77, 0.05};

template <class T>
Array<T> copy_of(std::span<const T> values) {
  return Array<T>(values.begin(), values.end());
}

/// Returns the exponent of the power of two that divides coordinates before they are summed. It is
/// 0 except for coordinates near the limits of float, where sums over a ring would overflow or
/// underflow.
int exponent_of(std::span<const glm::vec3> positions) {
  float most = 0.0F;
  for (const glm::vec3& p : positions)
    most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  constexpr int kFarFromTheEnd = 60;
  const int exponent = most > 0.0F ? std::ilogb(most) : 0;
  return exponent - std::clamp(exponent, -kFarFromTheEnd, kFarFromTheEnd);
}

/// Clamped, so that a scheme that overshoots the largest coordinates still gives finite ones.
glm::vec3 scaled(const glm::vec3& p, int exponent) {
  constexpr float kMost = std::numeric_limits<float>::max();
  const auto scale = [&](float x) { return std::clamp(std::ldexp(x, exponent), -kMost, kMost); };
  return {scale(p.x), scale(p.y), scale(p.z)};
}

/// Subdivides a mesh level by level.
class Subdivision {
 public:
  Subdivision(const Mesh& mesh, const SubdivideOptions& options)
      : mesh_(mesh),
        options_(options),
        coarse_(view_of(mesh)),
        rings_(coarse_, !traits(options.scheme).interpolates && thread_count() > 1),
        features_(features_of(mesh, options)),
        exponent_(exponent_of(mesh.positions())) {
    if (exponent_ == 0) return;
    for (const glm::vec3& p : mesh.positions())
      scaled_.push_back(scaled(p, -exponent_));
    coarse_.position = scaled_;
  }

  /// Runs all levels. Without `keeps_connectivity`, the last level has positions and origins only.
  void run(bool keeps_connectivity) {
    std::vector<double> weights(options_.levels, 1.0);
    for (std::size_t i = 1; i < weights.size(); ++i)
      weights[i] = kFacesPerFace * weights[i - 1];
    Stages stages(options_.progress, weights);
    for (std::uint32_t i = 1; i <= options_.levels; ++i) {
      stages.next(fmt::format("subdividing, level {} of {}", i, options_.levels));
      const bool is_bare = i == options_.levels && !keeps_connectivity;
      Level finer = step(is_bare);
      check_cancelled(options_.progress);
      if (!is_bare) features_ = next_features(features_, finer, options_);
      rings_.descend(coarse_.vertex_count());
      level_ = std::move(finer);
      coarse_ = level_.view();
    }
    if (options_.levels == 0) level_ = copy_of_coarse();
  }

  /// Scales the positions back. Vertices that never move get their original positions, bit for bit.
  /// Call it after all computations.
  void restore_size() {
    if (exponent_ == 0) return;
    for (glm::vec3& p : level_.position)
      p = scaled(p, exponent_);
    const bool stays =
        traits(options_.scheme).interpolates || (options_.levels == 0 && !options_.limit);
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
      if (stays || mesh_.is_isolated(Vertex(v))) level_.position[v] = mesh_.position(Vertex(v));
    }
  }

  /// Pre: connectivity was kept.
  Array<glm::vec3> move_to_limit() {
    LimitSurface limit = limit_surface(level_.view(), features_, options_);
    level_.position = std::move(limit.position);
    return std::move(limit.normal);
  }

  Level& level() { return level_; }

  /// Pre: connectivity was kept.
  Mesh finish() {
    MeshArrays arrays;
    arrays.sharpness = edge_sharpness();
    arrays.vertex_sharpness = vertex_sharpness();
    arrays.bow_tie_copies = copy_of(mesh_.bow_tie_copies());  // old vertices keep their ids
    arrays.position = std::move(level_.position);
    arrays.origin = std::move(level_.origin);
    arrays.twin = std::move(level_.twin);
    arrays.outgoing = std::move(level_.outgoing);
    return std::move(arrays).finish();
  }

 private:
  Level step(bool is_bare) const {
    switch (options_.scheme) {
      case Scheme::butterfly:
        return butterfly_step(coarse_, rings_, features_, options_, is_bare);
      case Scheme::midpoint:
        return midpoint_step(coarse_, options_, is_bare);
      case Scheme::loop:
        break;
    }
    return loop_step(coarse_, rings_, features_, options_, is_bare);
  }

  Level copy_of_coarse() const {
    return {copy_of(coarse_.position), copy_of(coarse_.origin), copy_of(coarse_.twin),
            copy_of(coarse_.outgoing)};
  }

  Array<float> edge_sharpness() const {
    if (options_.levels == 0) return copy_of(mesh_.sharpnesses());
    Array<float> sharpness(level_.origin.size(), 0.0F);
    for (const SharpEdge& edge : features_.edges()) {
      const Halfedge twin = level_.twin[edge.h.index()];
      if (!twin.is_valid()) continue;  // a boundary needs no tag
      sharpness[edge.h.index()] = sharpness[twin.index()] = edge.sharpness;
    }
    return sharpness;
  }

  /// Returns the decayed vertex tags of the mesh, without the sharpness that the boundary rule
  /// adds: that is derived again.
  Array<float> vertex_sharpness() const {
    if (mesh_.vertex_sharpnesses().empty()) return {};
    Array<float> sharpness(level_.position.size(), 0.0F);
    bool has_any = false;
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
      sharpness[v] = mesh_.sharpness(Vertex(v));
      for (std::uint32_t i = 0; i < options_.levels && is_semi_sharp(sharpness[v]); ++i)
        sharpness[v] = decayed(sharpness[v]);
      has_any = has_any || sharpness[v] > 0.0F;
    }
    return has_any || options_.levels == 0 ? sharpness : Array<float>{};
  }

  const Mesh& mesh_;
  const SubdivideOptions& options_;
  LevelView coarse_;
  Rings rings_;
  Features features_;
  Level level_;
  int exponent_;
  Array<glm::vec3> scaled_;  ///< the mesh's positions, if they are scaled
};

bool wants_limit(const SubdivideOptions& options) {
  return options.limit && traits(options.scheme).has_limit;
}

std::uint64_t mesh_bytes(std::uint64_t vertices, std::uint64_t faces) {
  constexpr std::uint64_t kVertex = sizeof(glm::vec3) + sizeof(Halfedge);
  constexpr std::uint64_t kFace = 3 * (sizeof(Vertex) + sizeof(Halfedge) + sizeof(float));
  return kVertex * vertices + kFace * faces;
}

}  // namespace

SubdivisionSize subdivision_size(const Mesh& mesh, const SubdivideOptions& options) {
  SubdivisionSize size;
  size.vertices = mesh.vertex_count();
  size.faces = mesh.face_count();
  std::uint64_t edges = mesh.count_edges();
  std::uint64_t sharp = count_sharp_edges(mesh);
  std::uint64_t last_bytes = 0;
  for (std::uint32_t i = 0; i < options.levels && size.has_ids; ++i) {
    last_bytes = i == 0 ? 0 : mesh_bytes(size.vertices, size.faces);
    size.vertices += edges;
    edges = 2 * edges + 3 * size.faces;
    size.faces *= 4;
    sharp *= 2;
    size.has_ids = 3 * size.faces < kNone && size.vertices < kNone;
  }
  size.result_bytes = mesh_bytes(size.vertices, size.faces);
  // The peak also has the previous level; the id of the new vertex on each of its half-edges, or
  // one point per vertex of it, which is less; the sharp features of both levels; and the rings of
  // the mesh.
  size.peak_bytes =
      size.result_bytes + last_bytes + 3 * sizeof(Vertex) * size.faces / 4 +
      kBytesPerSharpEdge * (sharp + sharp / 2) +
      sizeof(std::uint32_t) * (std::uint64_t{mesh.vertex_count()} + mesh.halfedge_count());
  if (wants_limit(options)) {
    const std::uint64_t normals = 3 * sizeof(glm::vec3) * size.faces;
    size.result_bytes += normals;
    size.peak_bytes += normals + sizeof(glm::vec3) * size.vertices;
  }
  return size;
}

Subdivided subdivide(const Mesh& mesh, const SubdivideOptions& options) {
  const SubdivisionSize size = subdivision_size(mesh, options);
  MESHER_ASSERT(size.has_ids);
  FaceLimit::check(size.faces, "the subdivided mesh ");
  Stages stages(options.progress, wants_limit(options) ? kLimitWeights : kStepWeights);
  stages.next();
  Subdivision subdivision(mesh, options);
  subdivision.run(true);
  stages.next();
  Subdivided result;
  if (wants_limit(options)) result.limit_normal = subdivision.move_to_limit();
  stages.next();
  subdivision.restore_size();
  check_cancelled(options.progress);
  result.mesh = subdivision.finish();
  return result;
}

IndexedTriangles subdivide_to_triangles(const Mesh& mesh, const SubdivideOptions& options) {
  MESHER_ASSERT(subdivision_size(mesh, options).has_ids);
  Stages stages(options.progress, wants_limit(options) ? kLimitWeights : kStepWeights);
  stages.next();
  Subdivision subdivision(mesh, options);
  subdivision.run(wants_limit(options));
  stages.next();
  if (wants_limit(options)) subdivision.move_to_limit();
  subdivision.restore_size();
  return {std::move(subdivision.level().position), std::move(subdivision.level().origin)};
}

}  // namespace mesher::subdivide
