#include "engine/mesh/edge_matching.h"

#include <algorithm>
#include <array>

#include "engine/core/parallel.h"
#include "engine/mesh/mesh.h"

namespace mesher {
namespace {

constexpr std::size_t kVertexChunk = 1 << 14;

struct Entry {
  std::uint32_t upper;
  std::uint32_t h;
  std::uint64_t key() const { return std::uint64_t{upper} << 32U | h; }
  friend auto operator<=>(const Entry&, const Entry&) = default;
};

/// So many are sorted by counting.
constexpr std::size_t kFew = 16;

Vertex target(const Array<Vertex>& origin, std::uint32_t h) {
  return origin[Mesh::next(Halfedge(h)).index()];
}

Vertex apex(const Array<Vertex>& origin, std::uint32_t h) {
  return origin[Mesh::prev(Halfedge(h)).index()];
}

/// Chains the half-edges of each lower vertex, by increasing index: `first` of the vertex, then
/// `link` of the half-edge before.
Array<Halfedge> chain(const Array<Vertex>& origin, std::uint32_t vertex_count,
                      Array<Halfedge>& link) {
  Array<Halfedge> first(vertex_count, Halfedge{});
  for (auto f = static_cast<std::uint32_t>(origin.size() / 3); f-- > 0;) {
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
  return first;
}

/// Sorts by counting how many come before each: no branch that a processor could guess wrong, which
/// is what sorting so few costs. Pre: entries differ; `sorted` has as many.
void sort_few(std::span<const Entry> entries, std::span<Entry> sorted) {
  for (const Entry& entry : entries) {
    std::size_t rank = 0;
    for (const Entry& other : entries)
      rank += other.key() < entry.key() ? 1U : 0U;
    sorted[rank] = entry;
  }
}

/// What one chunk of vertices found; joined in order of chunks.
struct Findings {
  std::uint64_t disagreeing_edges = 0;
  std::vector<std::uint32_t> crowded;
  std::vector<std::uint32_t> crowd_sizes;
  std::vector<std::uint32_t> duplicate_faces;
};

class Matcher {
 public:
  Matcher(const Array<Vertex>& origin, Array<Halfedge>& twin, Findings& findings)
      : origin_(origin), twin_(twin), findings_(findings) {}

  /// Matches the edges whose lower vertex has this chain. Its links lie where the twins will be:
  /// they are read before the first twin is written, and no other chain runs through them.
  void match_chain(Halfedge first) {
    std::array<Entry, kFew> few;
    std::size_t count = 0;
    Halfedge h = first;
    for (; h.is_valid() && count < kFew; h = twin_[h.index()])
      few[count++] = entry_of(h);
    if (!h.is_valid()) {
      std::array<Entry, kFew> sorted;
      sort_few({few.data(), count}, sorted);
      return match_sorted({sorted.data(), count});
    }
    many_.assign(few.begin(), few.end());
    for (; h.is_valid(); h = twin_[h.index()])
      many_.push_back(entry_of(h));
    std::sort(many_.begin(), many_.end());
    match_sorted(many_);
  }

 private:
  Entry entry_of(Halfedge h) const {
    return {std::max(origin_[h.index()], target(origin_, h.index())).index(), h.index()};
  }

  void match_sorted(std::span<const Entry> entries) {
    for (std::size_t begin = 0; begin < entries.size();) {
      std::size_t end = begin + 1;
      while (end < entries.size() && entries[end].upper == entries[begin].upper)
        ++end;
      match_edge(entries.subspan(begin, end - begin));
      begin = end;
    }
  }

  void match_edge(std::span<const Entry> edge) {
    if (edge.size() == 2) {
      const std::uint32_t a = edge[0].h;
      const std::uint32_t b = edge[1].h;
      twin_[a] = Halfedge(b);
      twin_[b] = Halfedge(a);
      findings_.disagreeing_edges += origin_[a] == origin_[b] ? 1 : 0;
      if (apex(origin_, a) == apex(origin_, b)) findings_.duplicate_faces.push_back(b / 3);
      return;
    }
    for (const Entry& entry : edge)
      twin_[entry.h] = Halfedge{};
    if (edge.size() > 2) note_crowd(edge);
  }

  void note_crowd(std::span<const Entry> edge) {
    for (const Entry& entry : edge)
      findings_.crowded.push_back(entry.h);
    findings_.crowd_sizes.push_back(static_cast<std::uint32_t>(edge.size()));
    // Faces of one edge are the same where their third vertex is.
    std::vector<Entry> by_apex;
    for (const Entry& entry : edge)
      by_apex.push_back({apex(origin_, entry.h).index(), entry.h});
    std::sort(by_apex.begin(), by_apex.end());
    for (std::size_t i = 1; i < by_apex.size(); ++i) {
      if (by_apex[i].upper == by_apex[i - 1].upper) {
        findings_.duplicate_faces.push_back(by_apex[i].h / 3);
      }
    }
  }

  const Array<Vertex>& origin_;
  Array<Halfedge>& twin_;
  Findings& findings_;
  std::vector<Entry> many_;
};

void join(const std::vector<Findings>& all, EdgeMatching& matching) {
  for (const Findings& part : all) {
    matching.disagreeing_edges += part.disagreeing_edges;
    matching.crowded.insert(matching.crowded.end(), part.crowded.begin(), part.crowded.end());
    for (const std::uint32_t size : part.crowd_sizes) {
      matching.crowd_start.push_back(matching.crowd_start.back() + size);
    }
    matching.duplicate_faces.insert(matching.duplicate_faces.end(), part.duplicate_faces.begin(),
                                    part.duplicate_faces.end());
  }
  // Each duplicate was seen from three edges.
  auto& faces = matching.duplicate_faces;
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
}

}  // namespace

EdgeMatching match_edges(const Array<Vertex>& origin, std::uint32_t vertex_count) {
  EdgeMatching matching;
  matching.twin.resize(origin.size());
  const Array<Halfedge> first = chain(origin, vertex_count, matching.twin);
  std::vector<Findings> findings(chunk_count(vertex_count, kVertexChunk));
  parallel_chunks(vertex_count, kVertexChunk, [&](std::size_t i, IndexRange range) {
    Matcher matcher(origin, matching.twin, findings[i]);
    for (std::size_t v = range.begin; v < range.end; ++v)
      matcher.match_chain(first[v]);
  });
  join(findings, matching);
  return matching;
}

}  // namespace mesher
