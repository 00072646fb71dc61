#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "engine/core/array.h"
#include "engine/mesh/ids.h"

namespace mesher {

/// One edge collapse. All ids are those of the mesh that `simplify` was given: an id keeps its
/// meaning while its vertex or face lives, and is never used again.
struct CollapseRecord {
  Halfedge halfedge;  ///< ran from `removed` to `kept`; its face vanished
  Halfedge twin;      ///< the other half of the edge, whose face vanished too; none on a boundary
  Vertex removed;
  Vertex kept;
  glm::vec3 position;  ///< where `kept` went
  /// Below kRanks: grows with the cost, 32 ranks an octave; at least that of each collapse before
  /// it whose one-rings have a vertex of this one's. So a stable sort by rank puts the collapses in
  /// an order in which each is legal, too, and which goes from the cheapest to the dearest over the
  /// whole mesh.
  std::uint32_t rank = 0;

  static constexpr std::uint32_t kRanks = 1U << 13U;
};

/// Is told of the collapses in an order in which each is legal after those before it, the same for
/// any number of threads.
class CollapseObserver {
 public:
  virtual ~CollapseObserver() = default;
  /// Called first: about how many collapses are to come, if the target is reached.
  virtual void expect(std::size_t collapses) { static_cast<void>(collapses); }
  /// Called on the thread that called `simplify`, for some collapses at a time.
  virtual void collapsed(std::span<const CollapseRecord> records) = 0;
};

/// Keeps them all. 32 bytes a collapse.
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

}  // namespace mesher
