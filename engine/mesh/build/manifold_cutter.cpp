#include "engine/mesh/build/manifold_cutter.h"

#include <algorithm>
#include <span>

#include "engine/core/error.h"
#include "engine/core/prefetch.h"
#include "engine/mesh/build/crowd_pairing.h"
#include "engine/mesh/circulators.h"
#include "engine/mesh/outgoing.h"

namespace mesher {

namespace {

constexpr std::size_t kCrowdChunk = std::size_t{1} << 12;
constexpr std::size_t kFanChunk = std::size_t{1} << 14;
constexpr std::size_t kHalfedgesBetweenReports = std::size_t{1} << 16;
/// Times of finding outgoing half-edges, counting fans (measured with 0.1, 1.4 and 13 million
/// faces), and separating them, which few models need.
constexpr double kCutWeights[] = {0.32, 0.68, 0.2};
/// Times of finding the fans, cutting crowds, splitting vertices, and finding outgoing half-edges
/// again.
constexpr double kSeparateWeights[] = {0.4, 0.2, 0.3, 0.1};

/// The half-edges of one crowd, sorted by the fans at both ends: those of parallel edges are
/// neighbors.
class CrowdByFans {
 public:
  CrowdByFans(const Array<std::uint32_t>& fan, std::span<const std::uint32_t> crowd) {
    reset(fan, crowd);
  }
  CrowdByFans() = default;

  void reset(const Array<std::uint32_t>& fan, std::span<const std::uint32_t> crowd) {
    entries_.clear();
    for (const std::uint32_t h : crowd) {
      const auto [low, high] = std::minmax({fan[h], fan[Mesh::next(Halfedge(h)).index()]});
      entries_.push_back({low, high, h});
    }
    std::sort(entries_.begin(), entries_.end());
  }

  /// Visits neighbors that join the same two fans, until `visit` returns false.
  template <class Visit>
  void for_each_parallel(Visit visit) const {
    for (std::size_t i = 1; i < entries_.size(); ++i) {
      const Entry& a = entries_[i - 1];
      const Entry& b = entries_[i];
      if (a.low == b.low && a.high == b.high && !visit(a.h, b.h)) return;
    }
  }

 private:
  struct Entry {
    std::uint32_t low, high;
    std::uint32_t h;
    friend auto operator<=>(const Entry&, const Entry&) = default;
  };

  std::vector<Entry> entries_;
};

/// Returns the root, with path halving.
Vertex root_of(Array<Vertex>& parent, Vertex v) {
  while (parent[v.index()] != v) {
    parent[v.index()] = parent[parent[v.index()].index()];
    v = parent[v.index()];
  }
  return v;
}

/// Joins the trees of two vertices. The lowest vertex of a tree is its root: most copies then hang
/// on a vertex of the input, and those are few enough to stay in the cache.
void join_trees(Array<Vertex>& parent, Vertex a, Vertex b) {
  const auto [low, high] = std::minmax({root_of(parent, a), root_of(parent, b)});
  parent[high.index()] = low;
}

}  // namespace

void ManifoldCutter::run(EdgeMatching&& matching, Progress* progress) {
  Stages stages(progress, kCutWeights);
  stages.next();
  matching_ = std::move(matching);
  mesh_.twin = std::move(matching_.twin);
  original_vertices_ = mesh_.position.size();
  cut_disagreeing(matching_.disagreeing_edges);
  report_[Repair::non_manifold_edges_cut] += matching_.crowd_count();
  pair_crowds(progress);
  fill_outgoing(mesh_, progress);
  stages.next();
  if (matching_.crowd_count() == 0 && has_single_fans(progress)) return;
  stages.next();
  separate_fans(progress);
}

void ManifoldCutter::cut_disagreeing(std::uint64_t expected) {
  if (expected == 0) return;
  report_[Repair::unorientable_edges_cut] += expected;
  for (std::uint32_t h = 0; h < mesh_.origin.size(); ++h) {
    const Halfedge t = mesh_.twin[h];
    if (!t.is_valid() || mesh_.origin[h] != mesh_.origin[t.index()]) continue;
    mesh_.twin[h] = mesh_.twin[t.index()] = Halfedge{};
    cut_disagreeing_.insert(cut_disagreeing_.end(), {h, t.index()});
  }
}

/// Visits some crowds in order. The faces of a crowd lie anywhere in memory, so `fetch(h)`
/// prefetches what the visit reads, a few crowds ahead: in dense polygon soup, each crowd would
/// otherwise wait for its cache lines.
template <class Fetch, class Visit>
void ManifoldCutter::for_each_crowd(IndexRange range, Fetch fetch, Visit visit) const {
  constexpr std::size_t kAhead = 96;  // half-edges
  const std::vector<std::uint32_t>& all = matching_.crowded;
  std::size_t ahead = matching_.crowd_start[range.begin];
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const std::size_t last = std::min(all.size(), matching_.crowd_start[i + 1] + kAhead);
    for (; ahead < last; ++ahead)
      fetch(all[ahead]);
    visit(i, matching_.crowd(i));
  }
}

void ManifoldCutter::pair_crowds(Progress* progress) {
  const auto pair = [this](std::size_t, IndexRange range) {
    CrowdPairing pairing(mesh_);
    const auto fetch = [this](std::uint32_t h) {
      prefetch(&mesh_.origin[h]);
      prefetch(&mesh_.twin[h]);
    };
    for_each_crowd(range, fetch, [&](std::size_t, auto crowd) { pairing.run(crowd); });
  };
  parallel_chunks(matching_.crowd_count(), kCrowdChunk, progress, pair);
}

bool ManifoldCutter::has_single_fans(Progress* progress) const {
  const TwinView twins{mesh_.twin};
  const auto met = parallel_sum<std::uint64_t>(
      mesh_.outgoing.size(), kFanChunk, progress, [&](IndexRange range) {
        std::uint64_t count = 0;
        for (std::size_t v = range.begin; v < range.end; ++v) {
          if (!mesh_.outgoing[v].is_valid()) continue;
          Circulator at(twins, mesh_.outgoing[v]);
          do {
            ++count;
          } while (at.advance());
        }
        return count;
      });
  // No half-edge belongs to two fans, so all are visited only if each vertex has one fan.
  return met == mesh_.origin.size();
}

void ManifoldCutter::separate_fans(Progress* progress) {
  Stages stages(progress, kSeparateWeights);
  stages.next();
  find_fans(progress);
  stages.next();
  cut_parallel_crowds(progress);
  stages.next();
  split_vertices(progress);
  list_bow_tie_copies();
  stages.next();
  fill_outgoing(mesh_, progress);
}

void ManifoldCutter::find_fans(Progress* progress) {
  fan_.assign(mesh_.origin.size(), kNone);
  // A fan of polygon soup lies anywhere in memory.
  const auto prefetch_fan = [&](std::uint32_t i) {
    if (i >= mesh_.twin.size()) return;
    const Halfedge second = mesh_.twin[Mesh::prev(Halfedge(i)).index()];
    if (!second.is_valid()) return;
    prefetch(&fan_[second.index()]);
    prefetch(&mesh_.twin[second.index()]);
  };
  ordered_chunks(mesh_.origin.size(), kHalfedgesBetweenReports, progress, [&](IndexRange range) {
    constexpr std::uint32_t kAhead = 32;
    for (auto i = static_cast<std::uint32_t>(range.begin); i < range.end; ++i) {
      prefetch_fan(i + kAhead);
      if (fan_[i] == kNone) visit_fan(Halfedge(i), [&](Halfedge h) { fan_[h.index()] = i; });
    }
  });
}

/// Visits the half-edges out of the origin of `h` that edges join with `h`: counterclockwise from
/// `h`, then clockwise if a boundary ends the walk.
template <class Visit>
void ManifoldCutter::visit_fan(Halfedge h, Visit visit) const {
  const TwinView twins{mesh_.twin};
  Circulator ccw(twins, h);
  do {
    visit(*ccw);
  } while (ccw.advance());
  if (ccw.is_closed()) return;
  for (Circulator<TwinView, Turn::cw> cw(twins, h); cw.advance();)
    visit(*cw);
}

// Pairing can leave two edges between the same two vertices, if the fans at both ends contain both
// edges. Such a crowd is cut completely. Then at most one half-edge in each direction remains
// between a fan of one end and a fan of the other, and those two are stitched.
void ManifoldCutter::cut_parallel_crowds(Progress* progress) {
  const std::vector<std::size_t> crowds = crowds_with_parallel_edges(progress);
  for (const std::size_t i : crowds) {
    for (const std::uint32_t h : matching_.crowd(i))
      mesh_.twin[h] = Halfedge{};
  }
  // Each half-edge of a crowd now bounds the two fans at its ends, so no fan is visited more often
  // than it has ends.
  for (const std::size_t i : crowds) {
    for (const std::uint32_t h : matching_.crowd(i)) {
      rename_fan(Halfedge(h));
      rename_fan(Mesh::next(Halfedge(h)));
    }
  }
  for (const std::size_t i : crowds) {
    CrowdByFans(fan_, matching_.crowd(i)).for_each_parallel([&](std::uint32_t a, std::uint32_t b) {
      if (mesh_.origin[a] == mesh_.origin[b]) return true;
      mesh_.twin[a] = Halfedge(b);
      mesh_.twin[b] = Halfedge(a);
      return true;
    });
  }
}

std::vector<std::size_t> ManifoldCutter::crowds_with_parallel_edges(Progress* progress) const {
  std::vector<std::vector<std::size_t>> found(chunk_count(matching_.crowd_count(), kCrowdChunk));
  parallel_chunks(matching_.crowd_count(), kCrowdChunk, progress,
                  [&](std::size_t chunk, IndexRange range) {
                    CrowdByFans by_fans;
                    const auto fetch = [this](std::uint32_t h) {
                      prefetch(&fan_[h]);
                      prefetch(&mesh_.twin[h]);
                    };
                    for_each_crowd(range, fetch, [&](std::size_t i, auto crowd) {
                      by_fans.reset(fan_, crowd);
                      by_fans.for_each_parallel([&](std::uint32_t a, std::uint32_t b) {
                        if (mesh_.twin[a] == Halfedge(b)) return true;
                        found[chunk].push_back(i);
                        return false;
                      });
                    });
                  });
  std::vector<std::size_t> all;
  for (const std::vector<std::size_t>& part : found)
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

void ManifoldCutter::rename_fan(Halfedge h) {
  std::uint32_t lowest = h.index();
  visit_fan(h, [&](Halfedge i) { lowest = std::min(lowest, i.index()); });
  visit_fan(h, [&](Halfedge i) { fan_[i.index()] = lowest; });
}

/// The first fan of a vertex keeps the vertex, and each other one gets a copy.
void ManifoldCutter::split_vertices(Progress* progress) {
  std::vector<bool> is_taken(original_vertices_, false);
  std::vector<bool> is_split(original_vertices_, false);
  const auto name = [&](Vertex v) {
    if (!is_taken[v.index()]) {
      is_taken[v.index()] = true;
      return v;
    }
    is_split[v.index()] = true;
    if (mesh_.position.size() >= kNone) throw InputError("too many vertices for 32-bit ids");
    const Vertex copy(static_cast<std::uint32_t>(mesh_.position.size()));
    mesh_.position.push_back(glm::vec3(mesh_.position[v.index()]));
    vertex_source_.push_back(std::uint32_t{vertex_source_[v.index()]});
    split_from_.push_back(v);
    return copy;
  };
  ordered_chunks(mesh_.origin.size(), kHalfedgesBetweenReports, progress, [&](IndexRange range) {
    for (std::size_t h = range.begin; h < range.end; ++h)
      mesh_.origin[h] = fan_[h] == h ? name(mesh_.origin[h]) : Vertex(mesh_.origin[fan_[h]]);
  });
  report_[Repair::non_manifold_vertices_cut] +=
      static_cast<std::uint64_t>(std::count(is_split.begin(), is_split.end(), true));
}

/// Returns a forest over the vertices, as the parent of each. Copies of a vertex are in one tree if
/// edges of the input joined their fans before they were cut.
Array<Vertex> ManifoldCutter::fans_joined_by_cut_edges() const {
  Array<Vertex> parent(mesh_.position.size());
  for (std::uint32_t v = 0; v < parent.size(); ++v)
    parent[v] = Vertex(v);
  const auto join_ends = [&](std::uint32_t g, std::uint32_t h) {
    const bool is_same_way = before_split(mesh_.origin[g]) == before_split(mesh_.origin[h]);
    join_trees(parent, mesh_.origin[g], is_same_way ? mesh_.origin[h] : target(h));
    join_trees(parent, target(g), is_same_way ? target(h) : mesh_.origin[h]);
  };
  const auto fetch_ends = [&](std::uint32_t h) {
    for (const Vertex v : {mesh_.origin[h], target(h)}) {
      prefetch(&parent[v.index()]);
      if (v.index() >= original_vertices_) prefetch(&split_from_[v.index() - original_vertices_]);
    }
  };
  constexpr std::size_t kCrowdsAhead = 4;
  const std::size_t crowds = matching_.crowd_count();
  const auto fetch = [this](std::uint32_t h) { prefetch(&mesh_.origin[h]); };
  for_each_crowd({0, crowds}, fetch, [&](std::size_t i, auto crowd) {
    if (i + kCrowdsAhead < crowds) {
      for (const std::uint32_t h : matching_.crowd(i + kCrowdsAhead))
        fetch_ends(h);
    }
    for (const std::uint32_t h : crowd)
      join_ends(crowd[0], h);
  });
  for (std::size_t i = 0; i < cut_disagreeing_.size(); i += 2)
    join_ends(cut_disagreeing_[i], cut_disagreeing_[i + 1]);
  return parent;
}

void ManifoldCutter::list_bow_tie_copies() {
  if (split_from_.empty()) return;
  Array<Vertex> parent = fans_joined_by_cut_edges();
  std::vector<bool> is_bow_tie(original_vertices_, false);
  for (std::size_t i = 0; i < split_from_.size(); ++i) {
    const Vertex copy(static_cast<std::uint32_t>(original_vertices_ + i));
    if (root_of(parent, copy) != root_of(parent, split_from_[i]))
      is_bow_tie[split_from_[i].index()] = true;
  }
  Array<BowTieCopy>& copies = mesh_.bow_tie_copies;
  for (std::uint32_t v = 0; v < original_vertices_; ++v) {
    if (is_bow_tie[v]) copies.push_back({Vertex(v), Vertex(v)});
  }
  for (std::size_t i = 0; i < split_from_.size(); ++i) {
    const Vertex copy(static_cast<std::uint32_t>(original_vertices_ + i));
    if (is_bow_tie[split_from_[i].index()]) copies.push_back({copy, split_from_[i]});
  }
}

}  // namespace mesher
