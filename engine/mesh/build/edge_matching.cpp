#include "engine/mesh/build/edge_matching.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <numeric>
#include <optional>

#include "engine/core/parallel.h"
#include "engine/core/prefetch.h"
#include "engine/mesh/mesh.h"

namespace mesher {
namespace {

constexpr std::size_t kVertexChunk = 1 << 14;
constexpr std::size_t kDenseChunk = 1 << 5;  // of vertices with many half-edges each
constexpr std::size_t kFacesBetweenReports = 1 << 16;
/// Times of chaining and matching, measured with 0.1, 1.4 and 13 million faces.
constexpr double kMatchWeights[] = {0.08, 0.92};

/// From this number of half-edges per vertex on, they are sorted in memory. The links of a chain
/// would lead to another cache line at each step: 10^6 faces at 1,000 vertices took three times as
/// long.
constexpr std::size_t kDenseValence = 48;
constexpr std::uint32_t kHalfedgesAhead = 32;  // half-edges to prefetch

/// A half-edge of the vertex at the lower end of its edge.
struct Entry {
  std::uint32_t upper;  ///< the vertex at the other end
  std::uint32_t h;
  std::uint32_t apex;  ///< the third vertex of the face
  friend auto operator<=>(const Entry&, const Entry&) = default;
};

Vertex target(const Array<Vertex>& origin, std::uint32_t h) {
  return origin[Mesh::next(Halfedge(h)).index()];
}

Vertex apex(const Array<Vertex>& origin, std::uint32_t h) {
  return origin[Mesh::prev(Halfedge(h)).index()];
}

/// Returns the edge's vertex other than `lower`, without a branch.
std::uint32_t upper(const Array<Vertex>& origin, std::uint32_t h, std::uint32_t lower) {
  return origin[h].index() ^ target(origin, h).index() ^ lower;
}

Entry entry_of(const Array<Vertex>& origin, std::uint32_t h, std::uint32_t lower) {
  return {upper(origin, h, lower), h, apex(origin, h).index()};
}

/// Chains the half-edges of each lower vertex by increasing index. `first` holds the head per
/// vertex, `link` the next half-edge per half-edge.
Array<Halfedge> chain(const Array<Vertex>& origin, std::uint32_t vertex_count,
                      Array<Halfedge>& link, Progress* progress) {
  Array<Halfedge> first(vertex_count, Halfedge{});
  const std::size_t faces = origin.size() / 3;
  ordered_chunks(faces, kFacesBetweenReports, progress, [&](IndexRange done) {
    const auto last = static_cast<std::uint32_t>(faces - done.end);
    for (auto f = static_cast<std::uint32_t>(faces - done.begin); f-- > last;) {
      const Vertex a = origin[3 * f];
      const Vertex b = origin[3 * f + 1];
      const Vertex c = origin[3 * f + 2];
      const auto push = [&](Vertex lower, std::uint32_t h) {
        link[h] = first[lower.index()];
        first[lower.index()] = Halfedge(h);
      };
      push(std::min(c, a), 3 * f + 2);
      push(std::min(b, c), 3 * f + 1);
      push(std::min(a, b), 3 * f);
    }
  });
  return first;
}

/// The half-edges of one lower vertex, usually few, in parallel arrays. Each is compared with all
/// others at once, without sorting and without a branch that could be mispredicted. The slot past
/// the last stands for none.
class FewHalfedges {
 public:
  static constexpr std::size_t kMost = 16;

  FewHalfedges() {
    upper_.fill(kNone);
    from_[kMost] = apex_[kMost] = h_[kMost] = kNone;
  }

  std::size_t size() const { return size_; }
  void push(const Array<Vertex>& origin, std::uint32_t lower, std::uint32_t h) {
    upper_[size_] = upper(origin, h, lower);
    from_[size_] = origin[h].index();
    apex_[size_] = apex(origin, h).index();
    h_[size_++] = h;
  }

  /// Writes all twins and returns the number of pairs that run in the same direction. Returns
  /// nothing, and writes nothing, if an edge has more than two half-edges or two faces are the
  /// same.
  std::optional<std::uint64_t> match(Array<Halfedge>& twin) const {
    std::array<std::size_t, kMost> mate;
    bool is_plain = true;
    for (std::size_t i = 0; i < size_; ++i) {
      const std::uint32_t same = equal_to(upper_[i]) ^ 1U << i;
      mate[i] = static_cast<std::size_t>(std::countr_zero(same | 1U << kMost));
      is_plain &= (same & (same - 1)) == 0 && apex_[i] != apex_[mate[i]];
    }
    if (!is_plain) return std::nullopt;
    std::uint64_t disagreeing = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      twin[h_[i]] = Halfedge(h_[mate[i]]);
      disagreeing += from_[i] == from_[mate[i]] ? 1U : 0U;
    }
    return disagreeing / 2;  // each pair was counted from both sides
  }

 private:
  using Numbers = std::array<std::uint32_t, kMost + 1>;
  using Four = std::uint32_t __attribute__((vector_size(16)));

  /// Returns one bit per slot whose upper vertex is `upper`.
  std::uint32_t equal_to(std::uint32_t upper) const {
    constexpr Four kBits{1U << 0, 1U << 1, 1U << 2, 1U << 3};
    Four bits{};
    for (std::uint32_t k = 0; k < kMost; k += 4) {
      Four four;
      std::memcpy(&four, &upper_[k], sizeof four);
      bits |= (four == upper) & kBits << k;
    }
    return (bits[0] | bits[1]) | (bits[2] | bits[3]);
  }

  std::size_t size_ = 0;
  std::array<std::uint32_t, kMost> upper_;
  Numbers from_;
  Numbers apex_;
  Numbers h_;
};

/// The findings for one chunk of vertices, joined in chunk order.
struct Findings {
  std::uint64_t disagreeing_edges = 0;
  std::vector<std::uint32_t> crowded;
  std::vector<std::uint32_t> crowd_sizes;
  std::vector<std::uint32_t> coincident_faces;
};

class Matcher {
 public:
  Matcher(const Array<Vertex>& origin, Array<Halfedge>& twin, Findings& findings)
      : origin_(origin), twin_(twin), findings_(findings) {}

  /// Matches the edges with this lower vertex, whose chain starts at `first`. The links of the
  /// chain are in the memory of the twins: they are read before the first twin is written, and no
  /// other chain uses them.
  void match_chain(std::uint32_t lower, Halfedge first) {
    FewHalfedges few;
    Halfedge h = first;
    for (; h.is_valid() && few.size() < FewHalfedges::kMost; h = twin_[h.index()])
      few.push(origin_, lower, h.index());
    if (!h.is_valid()) {
      if (const std::optional<std::uint64_t> disagreeing = few.match(twin_)) {
        findings_.disagreeing_edges += *disagreeing;
        return;
      }
    }
    many_.clear();
    for (h = first; h.is_valid(); h = twin_[h.index()])
      many_.push_back(entry_of(origin_, h.index(), lower));
    for (const Entry& entry : many_)
      twin_[entry.h] = Halfedge{};
    std::sort(many_.begin(), many_.end());
    match_sorted(many_);
  }

  /// Matches the edges of one lower vertex. Pre: sorted; none of them has a twin.
  void match_sorted(std::span<const Entry> entries) {
    for (std::size_t begin = 0; begin < entries.size();) {
      std::size_t end = begin + 1;
      while (end < entries.size() && entries[end].upper == entries[begin].upper)
        ++end;
      match_edge(entries.subspan(begin, end - begin));
      begin = end;
    }
  }

 private:
  void match_edge(std::span<const Entry> edge) {
    if (edge.size() == 2) {
      const std::uint32_t a = edge[0].h;
      const std::uint32_t b = edge[1].h;
      twin_[a] = Halfedge(b);
      twin_[b] = Halfedge(a);
      findings_.disagreeing_edges += origin_[a] == origin_[b] ? 1 : 0;
      if (edge[0].apex == edge[1].apex) note_coincident(edge[0], edge[1]);
    } else if (edge.size() > 2) {
      note_crowd(edge);
    }
  }

  void note_crowd(std::span<const Entry> edge) {
    for (const Entry& entry : edge)
      findings_.crowded.push_back(entry.h);
    findings_.crowd_sizes.push_back(static_cast<std::uint32_t>(edge.size()));
    // Faces at one edge are the same if their third vertices are.
    by_apex_.assign(edge.begin(), edge.end());
    std::sort(by_apex_.begin(), by_apex_.end(), [](const Entry& a, const Entry& b) {
      return a.apex != b.apex ? a.apex < b.apex : a.h < b.h;
    });
    for (std::size_t i = 1; i < by_apex_.size(); ++i) {
      if (by_apex_[i].apex == by_apex_[i - 1].apex) note_coincident(by_apex_[i - 1], by_apex_[i]);
    }
  }

  void note_coincident(const Entry& a, const Entry& b) {
    findings_.coincident_faces.push_back(a.h / 3);
    findings_.coincident_faces.push_back(b.h / 3);
  }

  const Array<Vertex>& origin_;
  Array<Halfedge>& twin_;
  Findings& findings_;
  std::vector<Entry> many_;
  std::vector<Entry> by_apex_;  ///< scratch
};

/// The half-edges of all edges, sorted by lower vertex, then by upper vertex, then by index.
struct SortedHalfedges {
  Array<Entry> entries;
  std::vector<std::size_t> start;  ///< per lower vertex, and the end

  std::span<const Entry> of(std::size_t lower) const {
    return std::span(entries).subspan(start[lower], start[lower + 1] - start[lower]);
  }
};

/// Returns where each key's values begin if they are sorted, and the end.
template <class Key>
std::vector<std::size_t> starts(std::uint32_t halfedges, std::uint32_t keys, const Key& key) {
  std::vector<std::size_t> start(std::size_t{keys} + 1, 0);
  for (std::uint32_t h = 0; h < halfedges; ++h)
    ++start[key(h) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  return start;
}

/// Sorts by two stable counting sorts, O(F + V).
SortedHalfedges sort_by_ends(const Array<Vertex>& origin, std::uint32_t vertex_count,
                             Progress* progress) {
  const auto lower = [&](std::uint32_t h) {
    return std::min(origin[h], target(origin, h)).index();
  };
  const auto higher = [&](std::uint32_t h) {
    return std::max(origin[h], target(origin, h)).index();
  };
  const auto halfedges = static_cast<std::uint32_t>(origin.size());
  Stages stages(progress, {1.0, 1.0});
  const auto each = [&](const auto& visit) {
    stages.next();
    ordered_chunks(halfedges, 3 * kFacesBetweenReports, progress, [&](IndexRange range) {
      for (auto i = static_cast<std::uint32_t>(range.begin); i < range.end; ++i)
        visit(i);
    });
  };
  Array<std::uint32_t> by_upper(halfedges);
  std::vector<std::size_t> next = starts(halfedges, vertex_count, higher);
  each([&](std::uint32_t h) { by_upper[next[higher(h)]++] = h; });
  SortedHalfedges sorted;
  sorted.start = starts(halfedges, vertex_count, lower);
  sorted.entries.resize(halfedges);
  next.assign(sorted.start.begin(), sorted.start.end());
  each([&](std::uint32_t i) {
    prefetch(&origin[by_upper[std::min(i + kHalfedgesAhead, halfedges - 1)]]);
    const std::uint32_t h = by_upper[i];
    const std::uint32_t v = lower(h);
    sorted.entries[next[v]++] = entry_of(origin, h, v);
  });
  return sorted;
}

void join(const std::vector<Findings>& all, EdgeMatching& matching) {
  for (const Findings& part : all) {
    matching.disagreeing_edges += part.disagreeing_edges;
    matching.crowded.insert(matching.crowded.end(), part.crowded.begin(), part.crowded.end());
    for (const std::uint32_t size : part.crowd_sizes) {
      matching.crowd_start.push_back(matching.crowd_start.back() + size);
    }
    matching.coincident_faces.insert(matching.coincident_faces.end(), part.coincident_faces.begin(),
                                     part.coincident_faces.end());
  }
  // Each face was found at three edges.
  auto& faces = matching.coincident_faces;
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
}

}  // namespace

EdgeMatching match_edges(const Array<Vertex>& origin, std::uint32_t vertex_count,
                         Progress* progress) {
  Stages stages(progress, kMatchWeights);
  stages.next();
  EdgeMatching matching;
  matching.twin.resize(origin.size());
  const auto match_all = [&](std::size_t chunk, const auto& match) {
    stages.next();
    std::vector<Findings> findings(chunk_count(vertex_count, chunk));
    parallel_chunks(vertex_count, chunk, progress, [&](std::size_t i, IndexRange range) {
      Matcher matcher(origin, matching.twin, findings[i]);
      for (std::size_t v = range.begin; v < range.end; ++v)
        match(matcher, v);
    });
    join(findings, matching);
  };
  if (origin.size() < kDenseValence * vertex_count) {
    const Array<Halfedge> first = chain(origin, vertex_count, matching.twin, progress);
    match_all(kVertexChunk, [&](Matcher& matcher, std::size_t v) {
      matcher.match_chain(static_cast<std::uint32_t>(v), first[v]);
    });
  } else {
    const SortedHalfedges sorted = sort_by_ends(origin, vertex_count, progress);
    std::fill(matching.twin.begin(), matching.twin.end(), Halfedge{});
    match_all(kDenseChunk,
              [&](Matcher& matcher, std::size_t v) { matcher.match_sorted(sorted.of(v)); });
  }
  return matching;
}

}  // namespace mesher
