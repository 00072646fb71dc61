#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "engine/simplify/fan.h"
#include "engine/simplify/options.h"
#include "engine/simplify/surface.h"

namespace mesher {

/// What merging an edge would cost, and where the vertex would go.
struct Candidate {
  float cost = kNever;  ///< what orders collapses, >= 0
  float error = 0.0F;   ///< what it does to the surface: area times squared distance
  glm::vec3 position{0.0F};
};

/// How well costs have to be known. Where the target is far the exact order does not matter, and a
/// policy may guess: an edge whose turn has come is looked at properly anyway.
enum class CostPrecision { guess, exact };

/// Which edge goes first, and where its vertex goes. `evaluate` and its siblings are called from
/// several threads at once; `collapsed` for vertices of different regions at once.
class CollapsePolicy {
 public:
  virtual ~CollapsePolicy() = default;

  /// Pre: allowed_placement(h) of the surface is `allowed`, and not nowhere.
  virtual Candidate evaluate(const Surface& surface, Halfedge h,
                             AllowedPlacement allowed) const = 0;

  /// The costs alone of several edges; kNever where allowed_placement(h) is nowhere. Where a policy
  /// has a faster way for many edges it gives the same bits, unless a guess will do.
  virtual void evaluate_costs(const Surface& surface, std::span<const Halfedge> edges,
                              CostPrecision precision, float* costs) const;

  /// The costs of the edges from the fan's vertex to each of its neighbors (around a closed fan,
  /// of which the last is the first again, that many less one). Writes up to eight places more.
  /// Pre: the fan is that of `v` as it is now, shapes included.
  virtual void evaluate_around(const Surface& surface, Vertex v, const Fan& fan,
                               CostPrecision precision, float* costs) const;

  /// Whether costs are areas times squared distances, so that other harm compares with them
  /// (appraisal.h). For a policy whose costs are something else, a collapse that turns or folds a
  /// face is refused.
  virtual bool costs_are_errors() const { return false; }

  /// `removed` has become one with `kept`.
  virtual void collapsed(Vertex removed, Vertex kept);
};

/// The policy that the options name.
std::unique_ptr<CollapsePolicy> make_policy(const SimplifyOptions& options, const Surface& surface);

/// Where the vertex of a merged edge goes: as an offset from the midpoint, and in the model. At an
/// end it is that end's position to the last bit.
struct Placed {
  Vec3<float> offset;
  glm::vec3 position;
};

/// Where placement and allowed put the vertex. Pre: `edge` is that of `h`, `allowed` is not
/// nowhere.
Placed place(const Surface& surface, Halfedge h, const EdgeQuadric<float>& edge,
             Placement placement, AllowedPlacement allowed);

}  // namespace mesher
