#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "engine/core/array.h"
#include "engine/mesh/ids.h"

namespace mesher::simplify {

/// One edge collapse. All ids are those of the mesh passed to `simplify`. An id keeps its meaning
/// while its vertex or face lives, and is never reused.
struct CollapseRecord {
  Halfedge halfedge;  ///< from `removed` to `kept`; its face was removed
  Halfedge twin;      ///< its twin, whose face was removed too; none on a boundary
  Vertex removed;
  Vertex kept;
  glm::vec3 position;  ///< new position of `kept`
  /// Below kRanks. Grows with the cost, 32 ranks per octave, and is at least the rank of every
  /// earlier collapse whose one-rings share a vertex with this one's. Hence a stable sort by rank
  /// also yields an order in which each collapse is legal; it goes from the cheapest to the most
  /// expensive over the whole mesh.
  std::uint32_t rank = 0;

  static constexpr std::uint32_t kRanks = 1U << 13U;
};

/// A collapse with what is needed to repeat it without computing its cost.
struct CollapseStep {
  CollapseRecord record;
  float error = 0.0F;     ///< Candidate::error
  float retreat = 0.0F;   ///< Appraisal::retreat
  float estimate = 0.0F;  ///< of ErrorBound
  bool is_plain = false;  ///< the estimate covers all changes: ErrorBound::covers_all
};

/// Receives the collapses in an order in which each is legal after those before it. The order does
/// not depend on the number of threads.
class CollapseObserver {
 public:
  virtual ~CollapseObserver() = default;
  /// Called first, with the approximate number of collapses if the target is reached.
  virtual void expect(std::size_t collapses) { static_cast<void>(collapses); }
  /// Called on the thread that called `simplify`, for several collapses at a time.
  virtual void collapsed(std::span<const CollapseRecord> records) = 0;
};

/// Stores all collapses. 32 bytes per collapse.
class CollapseRecorder : public CollapseObserver {
 public:
  void expect(std::size_t collapses) override { records_.reserve(records_.size() + collapses); }
  void collapsed(std::span<const CollapseRecord> records) override {
    records_.insert(records_.end(), records.begin(), records.end());
  }
  const Array<CollapseRecord>& records() const { return records_; }

 private:
  Array<CollapseRecord> records_;
};

}  // namespace mesher::simplify
