#include "engine/analysis/flipped_uvs.h"

#include <glm/geometric.hpp>

#include "engine/analysis/surface_matches.h"
#include "engine/analysis/uv_frame.h"
#include "engine/core/parallel.h"

namespace mesher::analysis {
namespace {

glm::dvec3 doubled_normal(const Mesh& mesh, Face f) {
  const auto [a, b, c] = corners_of(mesh, f);
  return glm::cross(b - a, c - a);
}

class FlipCounter {
 public:
  FlipCounter(const AttributedSurface& original, const TriangleTree& tree, double tolerance,
              const AttributedSurface& surface)
      : original_(original),
        surface_(surface),
        uvs_of_original_(original),
        uvs_(surface),
        finder_(tree, tolerance) {}

  FlippedUvs count(Face f) {
    const auto uv = uvs_.corners(f);
    const double turn = uv ? uv_orientation(*uv) : 0.0;
    if (turn == 0.0) return {};
    const glm::dvec3 normal = doubled_normal(surface_.mesh, f);
    const glm::dvec3 center = position_of(surface_.mesh, {f, glm::vec3(1.0F / 3.0F)});
    bool is_compared = false;
    for (const SurfacePoint& candidate : finder_.nearest(center)) {
      const auto other = uvs_of_original_.corners(candidate.face);
      const double other_turn = other ? uv_orientation(*other) : 0.0;
      const bool faces_same_way =
          glm::dot(normal, doubled_normal(original_.mesh, candidate.face)) > 0.0;
      if (other_turn == 0.0 || !faces_same_way) continue;
      if ((turn > 0.0) == (other_turn > 0.0)) return {0, 1, 0.0, 0.5 * glm::length(normal)};
      is_compared = true;
    }
    if (!is_compared) return {};
    return {1, 1, 0.5 * glm::length(normal), 0.5 * glm::length(normal)};
  }

 private:
  const AttributedSurface& original_;
  const AttributedSurface& surface_;
  UvLayers uvs_of_original_;
  UvLayers uvs_;
  NearestPoints finder_;
};

}  // namespace

FlippedUvs& FlippedUvs::operator+=(const FlippedUvs& other) {
  flipped += other.flipped;
  compared += other.compared;
  flipped_area += other.flipped_area;
  compared_area += other.compared_area;
  return *this;
}

FlippedUvs flipped_uvs(const AttributedSurface& original, const TriangleTree& tree,
                       const AttributedSurface& surface, Progress* progress) {
  constexpr std::size_t kFaces = 1024;
  const double tolerance = equally_near(original.mesh);
  return parallel_sum<FlippedUvs>(surface.mesh.face_count(), kFaces, progress,
                                  [&](IndexRange faces) {
                                    FlipCounter counter(original, tree, tolerance, surface);
                                    FlippedUvs sum;
                                    for (std::size_t f = faces.begin; f < faces.end; ++f)
                                      sum += counter.count(Face(static_cast<std::uint32_t>(f)));
                                    return sum;
                                  });
}

}  // namespace mesher::analysis
