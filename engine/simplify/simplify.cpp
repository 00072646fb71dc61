#include "engine/simplify/simplify.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <unordered_map>
#include <utility>

#include "engine/core/progress.h"
#include "engine/mesh/bow_tie_follower.h"
#include "engine/simplify/attribute_field.h"
#include "engine/simplify/handy_scale.h"
#include "engine/simplify/measured.h"
#include "engine/simplify/reorder.h"
#include "engine/simplify/rounds.h"

namespace mesher::simplify {
namespace {

/// Times of a run's stages: reordering, the first costs, collapsing, finishing. Medians of
/// simplifying 0.1, 1.4 and 13 million faces to 5 % on two cores.
constexpr double kRunWeights[] = {0.06, 0.1, 0.82, 0.02};

class Stopwatch {
 public:
  /// Returns the seconds since the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Converts positions to scaled units and back. Untouched vertices get back their original bits,
/// even if scaled coordinates underflowed.
class Units {
 public:
  explicit Units(Mesh& mesh) : scale_(handy_scale(mesh)) {
    if (scale_ == 1.0F) return;
    original_.assign(mesh.positions().begin(), mesh.positions().end());
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
      mesh.set_position(Vertex(v), scale_ * mesh.position(Vertex(v)));
  }

  float scale() const { return scale_; }
  glm::vec3 original(Vertex v, const glm::vec3& scaled) const {
    if (scale_ == 1.0F) return scaled;
    const glm::vec3& before = original_[v.index()];
    if (scale_ * before == scaled) return before;
    // An optimum may lie beyond the largest float in the caller's units.
    constexpr float kMost = std::numeric_limits<float>::max();
    return glm::clamp((1.0F / scale_) * scaled, -kMost, kMost);
  }

 private:
  float scale_;
  Array<glm::vec3> original_;
};

/// Translates records from the ids of the reordered mesh to the caller's.
class Translator {
 public:
  Translator(const Reordered& order, const Units& units) : order_(order), units_(units) {}

  void operator()(std::span<CollapseRecord> records) const {
    for (CollapseRecord& r : records) {
      r.position = units_.original(r.kept, r.position);
      r.halfedge = translated(r.halfedge);
      r.twin = translated(r.twin);
      r.removed = order_.vertex_source[r.removed.index()];
      r.kept = order_.vertex_source[r.kept.index()];
    }
  }

 private:
  Halfedge translated(Halfedge h) const {
    if (!h.is_valid()) return h;
    return Mesh::halfedge(order_.face_source[Mesh::face(h).index()], Mesh::corner(h));
  }

  const Reordered& order_;
  const Units& units_;
};

/// Tracks the copies of bow-tie vertices, and forwards records to the caller's observer. A pinned
/// vertex keeps its position but not its id: on a boundary, a collapse may remove it.
class BowTieObserver : public CollapseObserver {
 public:
  BowTieObserver(const Mesh& mesh, CollapseObserver* next) : follower_(mesh), next_(next) {}

  /// Returns the observer to pass to `simplify`.
  CollapseObserver* observer() { return follower_.is_empty() ? next_ : this; }
  void expect(std::size_t collapses) override {
    if (next_ != nullptr) next_->expect(collapses);
  }
  void collapsed(std::span<const CollapseRecord> records) override {
    for (const CollapseRecord& r : records)
      follower_.merge(r.removed, r.kept, r.position);
    if (next_ != nullptr) next_->collapsed(records);
  }
  /// Lists the copies in the result.
  void finish(Simplified& result) const {
    if (follower_.is_empty()) return;
    std::unordered_map<Vertex, Vertex> new_id;
    for (std::uint32_t v = 0; v < result.vertex_source.size(); ++v)
      new_id[result.vertex_source[v]] = Vertex(v);
    MeshArrays::open(result.mesh).bow_tie_copies =
        renamed(follower_.after(), [&](Vertex v) { return new_id.at(v); });
  }

 private:
  BowTieFollower follower_;
  CollapseObserver* next_;
};

/// Returns the remaining ids in the requested order. `source[i]` is the input's id of the current
/// id i.
template <class Id>
Array<Id> in_order(const Array<Id>& source, ResultOrder order, const Array<Id>& left) {
  Array<std::uint32_t> by_source(source.size(), kNone);
  for (const Id id : left)
    by_source[source[id.index()].index()] = id.index();
  Array<Id> result;
  result.reserve(left.size());
  if (order == ResultOrder::input) {
    for (const std::uint32_t i : by_source) {
      if (i != kNone) result.push_back(Id(i));
    }
    return result;
  }
  std::size_t mover = left.size();
  for (std::size_t slot = 0; slot < left.size(); ++slot) {
    if (by_source[slot] == kNone) {
      while (by_source[mover] == kNone)
        ++mover;
      result.push_back(Id(by_source[mover++]));
    } else {
      result.push_back(Id(by_source[slot]));
    }
  }
  return result;
}

Array<Face> faces_left(const Surface& surface) {
  Array<Face> left;
  for (std::uint32_t f = 0; f < surface.mesh().face_count(); ++f) {
    if (!surface.is_removed(Face(f))) left.emplace_back(f);
  }
  return left;
}

void finish(const Rounds& rounds, const Units& units, Trace& trace) {
  simplify::trace(rounds.surface(), trace);
  if (units.scale() == 1.0F) return;
  for (std::uint32_t v = 0; v < trace.after.vertex_count(); ++v) {
    const glm::vec3& scaled = trace.after.position(Vertex(v));
    trace.after.set_position(Vertex(v), units.original(trace.vertex_before[v], scaled));
  }
}

CornerVectors corner_vectors(const AttributeField& field, std::span<const Face> faces,
                             float scale) {
  CornerVectors corners;
  corners.values.reserve(3 * faces.size() * field.size());
  corners.source.reserve(3 * faces.size());
  for (const Face f : faces) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const Halfedge h = Mesh::halfedge(f, c);
      field.append_values(h, scale, corners.values);
      corners.source.push_back(field.source(h));
    }
  }
  corners.crosses_seams = field.has_crossed_seams();
  return corners;
}

Simplified finish(const Rounds& rounds, const Reordered& order, const Units& units,
                  const SimplifyOptions& options) {
  const KeptIds kept{in_order(order.vertex_source, options.order, rounds.vertices_left()),
                     in_order(order.face_source, options.order, faces_left(rounds.surface()))};
  Simplified result;
  result.mesh = compact(rounds.surface().mesh(), kept, options.progress);
  for (std::uint32_t v = 0; v < result.mesh.vertex_count() && units.scale() != 1.0F; ++v) {
    const glm::vec3& scaled = result.mesh.position(Vertex(v));
    result.mesh.set_position(Vertex(v), units.original(kept.vertices[v], scaled));
  }
  result.vertex_source.reserve(kept.vertices.size());
  for (const Vertex v : kept.vertices)
    result.vertex_source.push_back(order.vertex_source[v.index()]);
  result.face_source.reserve(kept.faces.size());
  for (const Face f : kept.faces)
    result.face_source.push_back(order.face_source[f.index()]);
  if (const AttributeField* field = rounds.attributes())
    result.corners = corner_vectors(*field, kept.faces, 1.0F / units.scale());
  return result;
}

}  // namespace

namespace {

/// Returns the input in the order in which it is processed. A later attempt has it already.
Reordered sorted_input(const Mesh& mesh, const SimplifyOptions& options, Attempts* attempts) {
  if (attempts == nullptr) return reorder_by_position(mesh, options.progress);
  if (!attempts->order) attempts->order = reorder_by_position(mesh, options.progress);
  return *attempts->order;
}

Guarding guarding(const SimplifyOptions& options) {
  if (!options.no_intersections) return Guarding::none;
  // An observer also sees the intermediate meshes, so looking the steps over is not enough.
  return options.observer == nullptr ? Guarding::where_needed : Guarding::everywhere;
}

}  // namespace

Simplified simplify_unmeasured(Mesh&& mesh, const SimplifyOptions& options, Trace* trace,
                               Attempts* attempts) {
  Stopwatch watch;
  SimplifyTimes seconds;
  Stages stages(options.progress, kRunWeights);
  stages.next("preparing");
  BowTieObserver bow_ties(mesh, options.observer);
  SimplifyOptions observed = options;
  observed.observer = bow_ties.observer();
  SimplifyReport report{.faces_before = mesh.face_count(),
                        .faces_asked = options.target_faces,
                        .vertices_before = mesh.vertex_count()};
  Reordered order = sorted_input(mesh, options, attempts);
  mesh = Mesh{};
  stages.next();
  if (trace != nullptr) trace->before = order.mesh;
  const Units units(order.mesh);
  AttributeMetric metric;
  if (options.metric != nullptr) {
    metric = of_faces(*options.metric, order.face_source, units.scale());
    observed.metric = &metric;
  }
  Rounds rounds(std::move(order.mesh), units.scale(), observed, Translator(order, units), attempts,
                guarding(options));
  seconds.prepare = watch.lap();
  stages.next("simplifying");
  rounds.run(report);
  seconds.collapse = watch.lap();
  stages.next("finishing");
  Simplified result = finish(rounds, order, units, options);
  bow_ties.finish(result);
  if (trace != nullptr) finish(rounds, units, *trace);
  seconds.finish = watch.lap();
  report.faces_reached = result.mesh.face_count();
  report.vertices_reached = result.mesh.vertex_count();
  report.seconds = seconds;
  result.report = report;
  return result;
}

Simplified simplify(Mesh&& mesh, const SimplifyOptions& options) {
  if (std::isfinite(options.max_error)) return simplify_measured(std::move(mesh), options);
  return options.certifies ? simplify_certified(std::move(mesh), options)
                           : simplify_unmeasured(std::move(mesh), options);
}

}  // namespace mesher::simplify
