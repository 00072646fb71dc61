#include "engine/subdivide/limit.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/subdivide/local_ring.h"
#include "engine/subdivide/ring_masks.h"

namespace mesher::subdivide {
namespace {

constexpr std::size_t kLimitGrain = 4096;
constexpr std::size_t kSharpChunk = 512;
/// Times of projecting all vertices as if they were smooth, and of correcting the sharp ones.
constexpr double kSmoothAndSharpWeights[] = {0.95, 0.05};

/// cos and sin of 2 pi i / n, precomputed for common valences n, one row per valence.
class TangentMasks {
 public:
  TangentMasks() {
    for (std::uint32_t n = 1; n < kCommon; ++n) {
      for (std::uint32_t i = 0; i < n; ++i)
        common_[n][i] = computed(n, i);
    }
  }
  glm::dvec2 operator()(std::uint32_t valence, std::uint32_t i) const {
    return valence < kCommon ? common_[valence][i] : computed(valence, i);
  }

 private:
  static constexpr std::uint32_t kCommon = 16;
  static glm::dvec2 computed(std::uint32_t valence, std::uint32_t i) {
    const double angle = 2.0 * std::numbers::pi * i / valence;
    return {std::cos(angle), std::sin(angle)};
  }
  std::array<std::array<glm::dvec2, kCommon>, kCommon> common_{};
};

/// Computes the limit as if everything were smooth; sharp vertices are corrected afterward.
class SmoothLimit {
 public:
  SmoothLimit(const LevelView& level, LimitSurface& limit) : level_(level), limit_(limit) {}

  void run(IndexRange vertices) const {
    std::vector<Halfedge> spokes;
    for (std::size_t v = vertices.begin; v < vertices.end; ++v)
      place(Vertex(static_cast<std::uint32_t>(v)), spokes);
  }

 private:
  void place(Vertex v, std::vector<Halfedge>& spokes) const {
    const glm::dvec3 own = level_.position[v.index()];
    limit_.position[v.index()] = own;
    const Halfedge start = level_.outgoing[v.index()];
    if (!start.is_valid() || !level_.twin[start.index()].is_valid()) return;
    spokes.clear();
    Halfedge h = start;
    do {
      spokes.push_back(h);
      h = level_.twin[Mesh::prev(h).index()];
    } while (h != start);
    const auto valence = static_cast<std::uint32_t>(spokes.size());
    glm::dvec3 sum(0.0);
    glm::dvec3 along(0.0);
    glm::dvec3 across(0.0);
    for (std::uint32_t i = 0; i < valence; ++i) {
      const glm::dvec3 end = level_.position[level_.origin[Mesh::next(spokes[i]).index()].index()];
      const glm::dvec2 tangent = tangents_(valence, i);
      sum += end;
      along += tangent.x * end;
      across += tangent.y * end;
    }
    const RingMasks::Weights weights = masks_(valence);
    limit_.position[v.index()] =
        static_cast<double>(weights.own) * own + static_cast<double>(weights.each) * sum;
    const glm::dvec3 cross = glm::cross(along, across);
    const double length = glm::length(cross);
    const glm::vec3 normal = length > 0.0 ? cross / length : glm::dvec3(0.0);
    for (const Halfedge spoke : spokes)
      limit_.normal[spoke.index()] = normal;
  }

  const LevelView& level_;
  LimitSurface& limit_;
  RingMasks masks_{loop_limit_mask};
  TangentMasks tangents_;
};

void place_sharp_limit(const LevelView& level, const Features& features,
                       const SubdivideOptions& options, IndexRange vertices, LimitSurface& limit) {
  LocalRing ring;
  for (std::size_t i = vertices.begin; i < vertices.end; ++i) {
    const SharpVertex& vertex = features.vertices()[i];
    ring.gather(level, features, vertex, options);
    ring.settle();
    limit.position[vertex.v.index()] = ring.limit_position();
    const auto normals = ring.limit_normals();
    for (std::size_t k = 0; k < normals.size(); ++k)
      limit.normal[ring.halfedges()[k].index()] = normals[k];
  }
}

}  // namespace

LimitSurface limit_surface(const LevelView& level, const Features& features,
                           const SubdivideOptions& options) {
  Stages stages(options.progress, kSmoothAndSharpWeights);
  stages.next("projecting to the limit");
  LimitSurface limit;
  limit.position.resize(level.position.size());
  limit.normal.resize(level.origin.size());
  const SmoothLimit smooth(level, limit);
  parallel_chunks(level.position.size(), kLimitGrain, options.progress,
                  [&](std::size_t, IndexRange vertices) { smooth.run(vertices); });
  stages.next("following creases to the limit");
  parallel_chunks(features.vertices().size(), kSharpChunk, options.progress,
                  [&](std::size_t, IndexRange vertices) {
                    place_sharp_limit(level, features, options, vertices, limit);
                  });
  return limit;
}

}  // namespace mesher::subdivide
