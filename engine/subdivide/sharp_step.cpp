#include "engine/subdivide/sharp_step.h"

#include "engine/core/parallel.h"
#include "engine/subdivide/sharpness.h"

namespace mesher {
namespace {

constexpr std::size_t kGrain = 4096;

glm::dvec3 point(const LevelView& level, const SharpVertex& vertex) {
  return level.position[vertex.v.index()];
}

/// Places what is sharp on one level.
class SharpStep {
 public:
  SharpStep(const LevelView& coarse, const Features& features, const SubdivideOptions& options)
      : coarse_(coarse), features_(features), rules_(options.creases) {}

  /// Pre: the new vertex is where the smooth mask has it.
  void place_on(const SharpEdge& edge, Level& finer) const {
    const SharpVertex& first = features_.vertices()[edge.end[0]];
    const SharpVertex& second = features_.vertices()[edge.end[1]];
    if (!has_sharp_mask(rules_, first.kind, second.kind)) return;
    const double weight = sharp_edge_weight(rules_, first.kind, second.kind);
    const glm::dvec3 sharp =
        weight * point(coarse_, first) + (1.0 - weight) * point(coarse_, second);
    glm::vec3& place = finer.position[edge_vertex(finer, edge.h).index()];
    const double blend = edge_blend(edge.sharpness, edge.left[0], edge.left[1]);
    place = blend >= 1.0 ? sharp : blend * sharp + (1.0 - blend) * glm::dvec3(place);
  }

  /// Pre: the vertex is where the smooth mask has it.
  void place(const SharpVertex& vertex, Level& finer) const {
    Sum before;
    Sum after;
    Transition transition;
    for (const std::uint32_t i : features_.at(vertex)) {
      const SharpEdge& edge = features_.edges()[i];
      const glm::dvec3 neighbour = point(coarse_, features_.other_end(edge, vertex));
      const float left = edge.left[features_.side(edge, vertex)];
      before.add(neighbour);
      if (left > 0.0F) after.add(neighbour);
      transition.add(edge.sharpness, left);
    }
    transition.add(vertex.own, decayed(vertex.own));
    const VertexRule rule = vertex_rule(vertex.own, before.count);
    const VertexRule next_rule = vertex_rule(decayed(vertex.own), after.count);
    if (rule == VertexRule::smooth) return;
    glm::vec3& place = finer.position[vertex.v.index()];
    const glm::dvec3 smooth = place;
    const glm::dvec3 sharper = placed(rule, vertex, before, smooth);
    if (rule == next_rule) {
      place = sharper;
    } else {
      const double weight = transition.weight();
      place = weight * sharper + (1.0 - weight) * placed(next_rule, vertex, after, smooth);
    }
  }

 private:
  struct Sum {
    glm::dvec3 sum{0.0};
    std::size_t count = 0;
    void add(const glm::dvec3& p) {
      sum += p;
      ++count;
    }
  };

  glm::dvec3 placed(VertexRule rule, const SharpVertex& vertex, const Sum& crease,
                    const glm::dvec3& smooth) const {
    if (rule == VertexRule::smooth) return smooth;
    const glm::dvec3 own = point(coarse_, vertex);
    if (rule == VertexRule::corner) return own;
    return kCreaseVertexMask.own * own + kCreaseVertexMask.each * crease.sum;
  }

  const LevelView& coarse_;
  const Features& features_;
  CreaseRules rules_;
};

}  // namespace

void place_sharp(const LevelView& coarse, const Features& features,
                 const SubdivideOptions& options, Level& finer) {
  const SharpStep sharp(coarse, features, options);
  parallel_for_each(features.edges().size(), kGrain,
                    [&](std::uint32_t i) { sharp.place_on(features.edges()[i], finer); });
  parallel_for_each(features.vertices().size(), kGrain,
                    [&](std::uint32_t i) { sharp.place(features.vertices()[i], finer); });
}

}  // namespace mesher
