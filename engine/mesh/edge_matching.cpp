#include "engine/mesh/edge_matching.h"

#include <algorithm>

#include "engine/core/parallel.h"
#include "engine/mesh/mesh.h"

namespace mesher {
namespace {

constexpr std::size_t kVertexChunk = 1 << 14;

struct Entry {
  std::uint32_t upper;
  std::uint32_t h;
  friend auto operator<=>(const Entry&, const Entry&) = default;
};

struct Buckets {
  Array<std::uint32_t> start;  ///< V+1
  Array<Entry> entries;        ///< 3F

  std::span<Entry> of(std::size_t v) {
    return {entries.data() + start[v], std::size_t{start[v + 1]} - start[v]};
  }
};

Vertex target(const Array<Vertex>& origin, std::uint32_t h) {
  return origin[Mesh::next(Halfedge(h)).index()];
}

Vertex apex(const Array<Vertex>& origin, std::uint32_t h) {
  return origin[Mesh::prev(Halfedge(h)).index()];
}

Buckets fill_buckets(const Array<Vertex>& origin, std::uint32_t vertex_count) {
  Buckets buckets;
  buckets.start.assign(std::size_t{vertex_count} + 1, 0);
  buckets.entries.resize(origin.size());
  const auto halfedges = static_cast<std::uint32_t>(origin.size());
  const auto lower = [&](std::uint32_t h) {
    return std::min(origin[h], target(origin, h)).index();
  };
  for (std::uint32_t h = 0; h < halfedges; ++h)
    ++buckets.start[lower(h)];
  std::uint32_t sum = 0;
  for (std::uint32_t& start : buckets.start)
    start = sum += start;
  // Filling from the back turns each end into its start, and leaves each bucket sorted by h.
  for (std::uint32_t h = halfedges; h-- > 0;) {
    const std::uint32_t upper = std::max(origin[h], target(origin, h)).index();
    buckets.entries[--buckets.start[lower(h)]] = {upper, h};
  }
  return buckets;
}

void sort_bucket(std::span<Entry> bucket) {
  if (bucket.size() > 24) {
    std::sort(bucket.begin(), bucket.end());
    return;
  }
  for (std::size_t i = 1; i < bucket.size(); ++i) {
    const Entry entry = bucket[i];
    std::size_t k = i;
    for (; k > 0 && entry < bucket[k - 1]; --k)
      bucket[k] = bucket[k - 1];
    bucket[k] = entry;
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

  void match_bucket(std::span<Entry> bucket) {
    sort_bucket(bucket);
    for (std::size_t begin = 0; begin < bucket.size();) {
      std::size_t end = begin + 1;
      while (end < bucket.size() && bucket[end].upper == bucket[begin].upper)
        ++end;
      match_edge(bucket.subspan(begin, end - begin));
      begin = end;
    }
  }

 private:
  void match_edge(std::span<Entry> edge) {
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

  void note_crowd(std::span<Entry> edge) {
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
  Buckets buckets = fill_buckets(origin, vertex_count);
  EdgeMatching matching;
  matching.twin.resize(origin.size());
  std::vector<Findings> findings(chunk_count(vertex_count, kVertexChunk));
  parallel_chunks(vertex_count, kVertexChunk, [&](std::size_t chunk, IndexRange range) {
    Matcher matcher(origin, matching.twin, findings[chunk]);
    for (std::size_t v = range.begin; v < range.end; ++v)
      matcher.match_bucket(buckets.of(v));
  });
  join(findings, matching);
  return matching;
}

}  // namespace mesher
