#include "engine/mesh/build/manifold_cutter.h"
#include "engine/mesh/circulators.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/prefetch.h"
#include "engine/mesh/outgoing.h"

namespace mesher {

/// A half-edge of a crowded edge, keyed by the vertices of its ends after splitting.
struct CrowdEntry {
  Vertex low, high;
  std::uint32_t h;
  friend auto operator<=>(const CrowdEntry&, const CrowdEntry&) = default;
  bool joins_same(const CrowdEntry& other) const { return low == other.low && high == other.high; }
};

namespace {

constexpr std::size_t kFanChunk = std::size_t{1} << 14;
constexpr std::size_t kHalfedgesBetweenReports = std::size_t{1} << 16;
/// Times of finding outgoing half-edges, counting fans (measured with 0.1, 1.4 and 13 million
/// faces), and separating them, which few models need.
constexpr double kCutWeights[] = {0.32, 0.68, 0.2};
/// Times of splitting vertices and finding outgoing half-edges again.
constexpr double kSeparateWeights[] = {1.0, 1.0};

/// Finds the root with path halving.
Vertex root_of(std::vector<Vertex>& parent, Vertex v) {
  while (parent[v.index()] != v) {
    parent[v.index()] = parent[parent[v.index()].index()];
    v = parent[v.index()];
  }
  return v;
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
  pair_crowds();
  fill_outgoing(mesh_, progress);
  stages.next();
  if (has_single_fans(progress) && matching_.crowd_count() == 0) return;
  stages.next();
  separate_fans(progress);
}

void ManifoldCutter::separate_fans(Progress* progress) {
  Stages stages(progress, kSeparateWeights);
  stages.next();
  split_vertices(progress);
  if (cut_parallel_crowds()) {
    undo_splits();
    split_vertices(progress);
    for (const std::size_t i : cut_crowds_)
      stitch(matching_.crowd(i));
  }
  report_[Repair::non_manifold_vertices_cut] += count_split_vertices();
  check_cancelled(progress);
  list_bow_tie_copies();
  stages.next();
  fill_outgoing(mesh_, progress);
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

/// Visits the crowds in order. The faces of a crowd lie anywhere in memory, so they are prefetched
/// a few crowds ahead: in dense polygon soup, each would otherwise wait for its cache lines.
template <class Visit>
void ManifoldCutter::for_each_crowd(Visit visit) const {
  constexpr std::size_t kAhead = 64;  // half-edges
  const std::vector<std::uint32_t>& all = matching_.crowded;
  std::size_t ahead = 0;
  for (std::size_t i = 0; i < matching_.crowd_count(); ++i) {
    const std::size_t last = std::min(all.size(), matching_.crowd_start[i + 1] + kAhead);
    for (; ahead < last; ++ahead) {
      prefetch(&mesh_.origin[all[ahead]]);
      prefetch(&mesh_.twin[all[ahead]]);
    }
    visit(i, matching_.crowd(i));
  }
}

void ManifoldCutter::pair_crowds() {
  for_each_crowd([this](std::size_t, std::span<const std::uint32_t> crowd) { pair_crowd(crowd); });
}

// Faces are sorted by angle around the edge, from its lower to its upper vertex. The inside of a
// face is the side that its normal points away from. It lies toward lower angles if the half-edge
// runs up, and toward higher angles if it runs down. So a "down" face and the next "up" face bound
// a wedge of solid. They are paired like brackets, and solids that touch along an edge are
// separated whole.
void ManifoldCutter::pair_crowd(std::span<const std::uint32_t> crowd) {
  const Vertex low = std::min(mesh_.origin[crowd[0]], target(crowd[0]));
  const Vertex high = std::max(mesh_.origin[crowd[0]], target(crowd[0]));
  const glm::dvec3 base = mesh_.position[low.index()];
  const glm::dvec3 axis = glm::dvec3(mesh_.position[high.index()]) - base;
  const glm::dvec3 aside =
      std::abs(axis.x) <= std::abs(axis.y) && std::abs(axis.x) <= std::abs(axis.z)
          ? glm::dvec3(1, 0, 0)
      : std::abs(axis.y) <= std::abs(axis.z) ? glm::dvec3(0, 1, 0)
                                             : glm::dvec3(0, 0, 1);
  const glm::dvec3 u = glm::cross(axis, aside);
  const glm::dvec3 v = glm::cross(axis, u) / std::max(glm::length(axis), 1e-300);
  std::vector<std::pair<double, std::uint32_t>> by_angle;
  for (const std::uint32_t h : crowd) {
    const Vertex apex = mesh_.origin[Mesh::prev(Halfedge(h)).index()];
    const glm::dvec3 d = glm::dvec3(mesh_.position[apex.index()]) - base;
    by_angle.emplace_back(std::atan2(glm::dot(d, v), glm::dot(d, u)), h);
  }
  std::sort(by_angle.begin(), by_angle.end());
  std::vector<std::uint32_t> open;
  for (int round = 0; round < 2; ++round) {
    for (const auto& [angle, h] : by_angle) {
      if (mesh_.twin[h].is_valid()) continue;
      const bool runs_up = mesh_.origin[h] == low;
      if (!runs_up && round == 0) open.push_back(h);
      if (!runs_up || open.empty()) continue;
      mesh_.twin[h] = Halfedge(open.back());
      mesh_.twin[open.back()] = Halfedge(h);
      open.pop_back();
    }
  }
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

void ManifoldCutter::split_vertices(Progress* progress) {
  std::vector<bool> is_done(mesh_.origin.size(), false);
  std::vector<bool> is_taken(original_vertices_, false);
  const TwinView twins{mesh_.twin};
  const auto split = [&](std::uint32_t i) {
    const Vertex v = mesh_.origin[i];
    Vertex name = v;
    if (is_taken[v.index()]) {
      if (mesh_.position.size() >= kNone) throw InputError("too many vertices for 32-bit ids");
      name = Vertex(static_cast<std::uint32_t>(mesh_.position.size()));
      mesh_.position.push_back(glm::vec3(mesh_.position[v.index()]));
      vertex_source_.push_back(std::uint32_t{vertex_source_[v.index()]});
      split_from_.push_back(v);
    }
    is_taken[v.index()] = true;
    Circulator at(twins, first_of_fan(twins, Halfedge(i)));
    do {
      is_done[(*at).index()] = true;
      mesh_.origin[(*at).index()] = name;
    } while (at.advance());
  };
  // A fan of polygon soup lies anywhere in memory.
  const auto prefetch_fan = [&](std::uint32_t i) {
    if (i >= mesh_.twin.size()) return;
    const Halfedge second = mesh_.twin[Mesh::prev(Halfedge(i)).index()];
    if (!second.is_valid()) return;
    prefetch(&mesh_.origin[second.index()]);
    prefetch(&mesh_.twin[second.index()]);
  };
  ordered_chunks(mesh_.origin.size(), kHalfedgesBetweenReports, progress, [&](IndexRange range) {
    constexpr std::uint32_t kAhead = 32;
    for (auto i = static_cast<std::uint32_t>(range.begin); i < range.end; ++i) {
      prefetch_fan(i + kAhead);
      if (!is_done[i]) split(i);
    }
  });
}

std::vector<CrowdEntry> ManifoldCutter::sorted_by_ends(std::span<const std::uint32_t> crowd) const {
  std::vector<CrowdEntry> entries;
  for (const std::uint32_t h : crowd) {
    const auto [low, high] = std::minmax({mesh_.origin[h], target(h)});
    entries.push_back({low, high, h});
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

bool ManifoldCutter::has_parallel_edges(std::span<const std::uint32_t> crowd) const {
  const std::vector<CrowdEntry> entries = sorted_by_ends(crowd);
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].joins_same(entries[i - 1]) &&
        mesh_.twin[entries[i].h] != Halfedge(entries[i - 1].h)) {
      return true;
    }
  }
  return false;
}

// Pairing can leave two edges between the same two vertices, if the fans at both ends contain both
// edges. Such a crowd is cut completely. Then at most one half-edge in each direction remains
// between a fan's copy of one end and a fan's copy of the other, and those two are stitched.
bool ManifoldCutter::cut_parallel_crowds() {
  for_each_crowd([this](std::size_t i, std::span<const std::uint32_t> crowd) {
    if (has_parallel_edges(crowd)) cut_crowds_.push_back(i);
  });
  for (const std::size_t i : cut_crowds_) {
    for (const std::uint32_t h : matching_.crowd(i))
      mesh_.twin[h] = Halfedge{};
  }
  return !cut_crowds_.empty();
}

void ManifoldCutter::undo_splits() {
  for (Vertex& v : mesh_.origin) {
    if (v.index() >= original_vertices_) v = split_from_[v.index() - original_vertices_];
  }
  mesh_.position.resize(original_vertices_);
  vertex_source_.resize(original_vertices_);
  split_from_.clear();
}

std::uint64_t ManifoldCutter::count_split_vertices() const {
  std::vector<Vertex> split = split_from_;  // a vertex occurs once per copy
  std::sort(split.begin(), split.end());
  return static_cast<std::uint64_t>(std::unique(split.begin(), split.end()) - split.begin());
}

/// Returns a forest over the vertices, as the parent of each. Copies of a vertex are in one tree if
/// edges of the input joined their fans before they were cut.
std::vector<Vertex> ManifoldCutter::fans_joined_by_cut_edges() const {
  std::vector<Vertex> parent;
  for (std::uint32_t v = 0; v < mesh_.position.size(); ++v)
    parent.emplace_back(v);
  const auto join = [&](Vertex a, Vertex b) {
    parent[root_of(parent, a).index()] = root_of(parent, b);
  };
  const auto join_ends = [&](std::uint32_t g, std::uint32_t h) {
    const bool is_same_way = before_split(mesh_.origin[g]) == before_split(mesh_.origin[h]);
    join(mesh_.origin[g], is_same_way ? mesh_.origin[h] : target(h));
    join(target(g), is_same_way ? target(h) : mesh_.origin[h]);
  };
  for_each_crowd([&](std::size_t, std::span<const std::uint32_t> crowd) {
    for (const std::uint32_t h : crowd)
      join_ends(crowd[0], h);
  });
  for (std::size_t i = 0; i < cut_disagreeing_.size(); i += 2)
    join_ends(cut_disagreeing_[i], cut_disagreeing_[i + 1]);
  return parent;
}

void ManifoldCutter::list_bow_tie_copies() {
  if (split_from_.empty()) return;
  std::vector<Vertex> parent = fans_joined_by_cut_edges();
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

void ManifoldCutter::stitch(std::span<const std::uint32_t> crowd) {
  const std::vector<CrowdEntry> entries = sorted_by_ends(crowd);
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const std::uint32_t a = entries[i - 1].h;
    const std::uint32_t b = entries[i].h;
    if (!entries[i].joins_same(entries[i - 1]) || mesh_.origin[a] == mesh_.origin[b]) continue;
    mesh_.twin[a] = Halfedge(b);
    mesh_.twin[b] = Halfedge(a);
  }
}

}  // namespace mesher
