// Measures the cost of the queue in greedy edge collapse (docs/efficiency.md). Each step collapses
// the shortest legal edge to its midpoint, so most of the work is in the queue.
#include <benchmark/benchmark.h>

#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <compare>
#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "engine/mesh/build/build.h"
#include "engine/mesh/circulators.h"
#include "engine/mesh/collapse.h"
#include "tests/bench/models.h"
#include "tests/bench/settings.h"

namespace mesher::bench {
namespace {

using State = benchmark::State;

/// The squared length of the edge.
float cost_of(const Mesh& mesh, Halfedge h) {
  const glm::vec3 along = mesh.position(mesh.target(h)) - mesh.position(mesh.origin(h));
  return glm::dot(along, along);
}

/// A half-edge with its cost at the time of insertion. The cost is checked again when the entry is
/// removed.
struct Entry {
  float cost = 0.0F;
  Halfedge halfedge;
  friend auto operator<=>(const Entry&, const Entry&) = default;
};

bool is_current(const Mesh& mesh, const Entry& entry) {
  return entry.halfedge.index() < mesh.halfedge_count() &&
         cost_of(mesh, entry.halfedge) == entry.cost;
}

/// No queue: scans all edges for each collapse. O(F) per collapse.
class NaiveScan {
 public:
  void push(const Entry&) {}
  Halfedge take(const Mesh& mesh) {
    Entry best{std::numeric_limits<float>::infinity(), {}};
    for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
      const Halfedge h(i);
      const float cost = cost_of(mesh, h);
      if (cost < best.cost && check_collapse(mesh, h).is_legal()) best = {cost, h};
    }
    return best.halfedge;
  }
};

/// A binary heap. Changed edges are inserted again, and outdated entries are dropped when they
/// reach the top. O(log F) per push or pop.
class Heap {
 public:
  void push(const Entry& entry) { heap_.push(entry); }
  Halfedge take(const Mesh& mesh) {
    while (!heap_.empty()) {
      const Entry entry = heap_.top();
      heap_.pop();
      if (is_current(mesh, entry) && check_collapse(mesh, entry.halfedge).is_legal())
        return entry.halfedge;
    }
    return {};
  }

 private:
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap_;
};

/// One bucket per value of the exponent and the first 7 bits of the mantissa of the cost, first in,
/// first out within a bucket: costs are sorted to within 1 %. O(1) per push or pop, except for
/// empty buckets that are skipped.
class Buckets {
 public:
  void push(const Entry& entry) {
    const std::size_t i = std::bit_cast<std::uint32_t>(entry.cost) >> 16U;
    buckets_[i].entries.push_back(entry);
    lowest_ = std::min(lowest_, i);
  }
  Halfedge take(const Mesh& mesh) {
    for (; lowest_ < kBuckets; ++lowest_) {
      for (Bucket& bucket = buckets_[lowest_]; bucket.taken < bucket.entries.size();) {
        const Entry entry = bucket.entries[bucket.taken++];
        if (is_current(mesh, entry) && check_collapse(mesh, entry.halfedge).is_legal())
          return entry.halfedge;
      }
      buckets_[lowest_] = {};
    }
    return {};
  }

 private:
  struct Bucket {
    std::vector<Entry> entries;
    std::size_t taken = 0;
  };
  static constexpr std::size_t kBuckets = 1U << 15U;  // of a float without its sign
  std::vector<Bucket> buckets_ = std::vector<Bucket>(kBuckets);
  std::size_t lowest_ = kBuckets;
};

/// Inserts the edges that a collapse changed: those at the moved vertex and those of faces with a
/// new id.
template <class Queue>
void push_changed(const Mesh& mesh, const CollapseResult& result, Queue& queue) {
  const auto push = [&](Halfedge h) { queue.push({cost_of(mesh, h), h}); };
  for (const Halfedge h : halfedges_around(mesh, result.kept))
    push(h);
  for (const CollapseResult::Move& move : result.face_moves) {
    if (move.to >= mesh.face_count()) continue;
    for (std::uint32_t corner = 0; corner < 3; ++corner)
      push(Mesh::halfedge(Face(move.to), corner));
  }
}

template <class Queue>
void collapse_shortest(Mesh& mesh, std::uint32_t target_faces) {
  Queue queue;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge h(i);
    if (Mesh::halfedge(mesh.edge(h)) == h) queue.push({cost_of(mesh, h), h});
  }
  while (mesh.face_count() > target_faces) {
    const Halfedge h = queue.take(mesh);
    if (!h.is_valid()) return;
    const glm::vec3 middle = 0.5F * (mesh.position(mesh.origin(h)) + mesh.position(mesh.target(h)));
    push_changed(mesh, collapse(mesh, h, middle), queue);
  }
}

template <class Queue>
void add(const std::string& who, std::uint32_t size) {
  const std::uint32_t faces = 2 * size * size;
  const auto run = [size](State& state) {
    const Mesh input = build_mesh(bumpy_torus(size)).mesh;
    for (auto _ : state) {
      Mesh mesh = input;
      const auto start = std::chrono::steady_clock::now();
      collapse_shortest<Queue>(mesh, input.face_count() / 10);
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
      state.SetIterationTime(elapsed.count());
      if (mesh.face_count() > input.face_count() / 10) state.SkipWithError("stopped short");
    }
    state.counters["items"] = input.face_count();
  };
  const std::string name = "queue_growth_" + std::to_string(faces) + "/" + who;
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_queue(const Settings&) {
  constexpr std::uint32_t kNaiveSize = 71;  // 10,082 faces
  for (const std::uint32_t size : {22U, 39U, 71U, 126U, 224U}) {
    if (size <= kNaiveSize) add<NaiveScan>("naive scan", size);
    add<Heap>("binary heap", size);
    add<Buckets>("buckets", size);
  }
}

}  // namespace mesher::bench
