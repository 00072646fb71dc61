#include "engine/subdivide/sharp_step.h"

#include <array>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/subdivide/sharp_masks.h"

namespace mesher::subdivide {
namespace {

constexpr std::size_t kSharpGrain = 4096;

glm::dvec3 point(const LevelView& level, const SharpVertex& vertex) {
  return level.position[vertex.v.index()];
}

glm::dvec3 edge_point(const LevelView& coarse, const Features& features, CreaseRules rules,
                      const SharpEdge& edge, const glm::dvec3& smooth) {
  const SharpVertex& first = features.vertices()[edge.end[0]];
  const SharpVertex& second = features.vertices()[edge.end[1]];
  return sharp_edge_point(rules,
                          {.end = {point(coarse, first), point(coarse, second)},
                           .kind = {first.kind, second.kind},
                           .sharpness = edge.sharpness,
                           .left = edge.left},
                          smooth);
}

/// `spokes` is scratch.
glm::dvec3 vertex_point(const LevelView& coarse, const Features& features,
                        const SharpVertex& vertex, const glm::dvec3& smooth,
                        std::vector<SharpSpoke>& spokes) {
  spokes.clear();
  for (const std::uint32_t i : features.at(vertex)) {
    const SharpEdge& edge = features.edges()[i];
    spokes.push_back({.end = point(coarse, features.other_end(edge, vertex)),
                      .before = edge.sharpness,
                      .after = edge.left[features.side(edge, vertex)]});
  }
  return sharp_vertex_point(point(coarse, vertex), vertex.own, spokes, smooth);
}

}  // namespace

void place_sharp(const LevelView& coarse, const Features& features, const SubdivideOptions& options,
                 Level& finer) {
  parallel_for_each(features.edges().size(), kSharpGrain, [&](std::uint32_t i) {
    const SharpEdge& edge = features.edges()[i];
    glm::vec3& position = finer.position[edge_vertex(finer, edge.h).index()];
    position = edge_point(coarse, features, options.creases, edge, position);
  });
  parallel_for(features.vertices().size(), kSharpGrain, [&](IndexRange range) {
    std::vector<SharpSpoke> spokes;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const SharpVertex& vertex = features.vertices()[i];
      glm::vec3& position = finer.position[vertex.v.index()];
      position = vertex_point(coarse, features, vertex, position, spokes);
    }
  });
}

}  // namespace mesher::subdivide
