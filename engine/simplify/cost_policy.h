#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "engine/simplify/fan.h"
#include "engine/simplify/options.h"
#include "engine/simplify/surface.h"

namespace mesher::simplify {

class AttributeField;

/// Cost and result of merging an edge.
struct Candidate {
  float cost = kNever;  ///< order of collapses, >= 0
  float error = 0.0F;   ///< harm to the surface: area times squared distance
  glm::vec3 position{0.0F};
};

/// Required precision of costs. Far from the target the exact order does not matter, so a policy
/// may guess: an edge is evaluated exactly anyway when it reaches the front of the queue.
enum class CostPrecision { guess, exact };

/// Decides which edge is collapsed first and where its vertex is placed. Several threads may call
/// `evaluate` and its siblings at once, and `collapsing` for vertices of different regions.
class CollapsePolicy {
 public:
  virtual ~CollapsePolicy() = default;

  /// Returns cost and placement. Pre: `allowed` is surface.allowed_placement(h), and not nowhere.
  /// It is `across` only if the policy follows attributes.
  virtual Candidate evaluate(const Surface& surface, Halfedge h,
                             AllowedPlacement allowed) const = 0;

  /// Writes the costs of several edges; kNever if allowed_placement(h) is nowhere. A faster
  /// implementation for many edges must yield the same bits, unless `precision` is guess.
  virtual void evaluate_costs(const Surface& surface, std::span<const Halfedge> edges,
                              CostPrecision precision, float* costs) const;

  /// Writes the costs of the edges from the fan's vertex to each of its neighbors: one per entry of
  /// fan.ring(), without the repeated first one of a closed fan. May write up to eight values past
  /// the end. Pre: the fan is that of `v` in its current state, shapes included.
  virtual void evaluate_around(const Surface& surface, Vertex v, const Fan& fan,
                               CostPrecision precision, float* costs) const;

  /// Returns whether costs are areas times squared distances, so that other damage is commensurable
  /// with them (appraisal.h). If not, a collapse that turns or folds a face is refused.
  virtual bool costs_are_errors() const { return false; }

  /// Returns whether a collapse keeps what the policy protects. Pre: `fan` is that of `h`.
  virtual bool allows(const Surface& surface, Halfedge h, const Fan& fan, const glm::vec3& p) const;

  /// Called before the edge of `h` is merged at `p`: its origin into its target. Pre: `fan` is that
  /// of `h`.
  virtual void collapsing(const Surface& surface, Halfedge h, const Fan& fan, const glm::vec3& p);

  /// Prefetches what the calls for the edge of `h` will read of the policy's own data: first what
  /// leads there, then the data.
  virtual void will_need_later(Halfedge h) const;
  virtual void will_need(const Mesh& mesh, Halfedge h) const;
  virtual void will_need(const Fan& fan) const;

  /// Returns whether costs depend on earlier collapses otherwise than through the surface and the
  /// attributes. Such a run cannot be taken back in part.
  virtual bool has_history() const { return false; }

  /// Returns the attributes that the policy follows, or null.
  virtual AttributeField* attributes() { return nullptr; }
};

/// Returns whether the policy selected by the options counts their metric: only the default one
/// does.
bool follows_attributes(const SimplifyOptions& options);

/// Returns the policy selected by the options.
std::unique_ptr<CollapsePolicy> make_policy(const SimplifyOptions& options, const Surface& surface);

/// Position of a merged vertex, as an offset from the edge's midpoint and in model space. At an end
/// of the edge, the position equals that end bit for bit.
struct Placed {
  Vec3<float> offset;
  glm::vec3 position;
};

/// Returns the position of the merged vertex. Pre: `edge` is that of `h`, `allowed` is not nowhere.
Placed place(const Surface& surface, Halfedge h, const EdgeQuadric<float>& edge,
             Placement placement, AllowedPlacement allowed);

}  // namespace mesher::simplify
