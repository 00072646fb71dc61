#include "engine/io/obj_creases.h"

#include <algorithm>
#include <utility>

#include "engine/core/error.h"

namespace mesher::io {
namespace {

using VertexPair = std::pair<std::uint32_t, std::uint32_t>;

VertexPair ordered(std::uint32_t a, std::uint32_t b) {
  return std::minmax(a, b);
}

/// Pairs of vertices, and a flag for each pair that is an edge of some face.
class EdgeSearch {
 public:
  EdgeSearch(std::vector<VertexPair> pairs, std::size_t vertex_count)
      : pairs_(std::move(pairs)), is_named_(vertex_count, false) {
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    found_.assign(pairs_.size(), false);
    for (const auto& [a, b] : pairs_) {
      if (b < vertex_count) is_named_[a] = is_named_[b] = true;
    }
  }

  void look_at(std::uint32_t a, std::uint32_t b) {
    // Nearly every edge of a mesh returns here; only a few need the search.
    if (!is_named_[a] || !is_named_[b]) return;
    const auto at = std::lower_bound(pairs_.begin(), pairs_.end(), ordered(a, b));
    if (at != pairs_.end() && *at == ordered(a, b)) found_[at - pairs_.begin()] = true;
  }

  bool is_edge(std::uint32_t a, std::uint32_t b) const {
    const auto at = std::lower_bound(pairs_.begin(), pairs_.end(), ordered(a, b));
    return at != pairs_.end() && *at == ordered(a, b) && found_[at - pairs_.begin()];
  }

 private:
  std::vector<VertexPair> pairs_;
  std::vector<bool> found_;
  std::vector<bool> is_named_;
};

void look_at_edges(const Soup& soup, EdgeSearch& search) {
  std::size_t begin = 0;
  for (std::uint32_t f = 0; f < soup.face_count(); ++f) {
    const std::size_t end = soup.face_start.empty() ? begin + 3 : soup.face_start[f + 1];
    for (std::size_t c = begin; c < end; ++c) {
      search.look_at(soup.corners[c], soup.corners[c + 1 < end ? c + 1 : begin]);
    }
    begin = end;
  }
}

std::uint32_t likelier_base(const std::vector<ObjTag>& tags, const Soup& soup) {
  std::vector<VertexPair> pairs;
  for (const ObjTag& tag : tags) {
    if (tag.is_based_on_zero) continue;
    pairs.push_back(ordered(tag.a, tag.b));
    if (tag.a > 0 && tag.b > 0) pairs.push_back(ordered(tag.a - 1, tag.b - 1));
  }
  if (pairs.empty()) return 0;
  EdgeSearch search(std::move(pairs), soup.positions.size());
  look_at_edges(soup, search);
  std::size_t edges[2] = {};
  for (const ObjTag& tag : tags) {
    if (tag.is_based_on_zero) continue;
    edges[0] += search.is_edge(tag.a, tag.b) ? 1 : 0;
    edges[1] += tag.a > 0 && tag.b > 0 && search.is_edge(tag.a - 1, tag.b - 1) ? 1 : 0;
  }
  return edges[1] > edges[0] ? 1 : 0;
}

}  // namespace

void add_obj_tags(const MappedFile& file, std::optional<int> base, const std::vector<ObjTag>& tags,
                  Soup& soup) {
  if (tags.empty()) return;
  const std::uint32_t e_base = base ? static_cast<std::uint32_t>(*base) : likelier_base(tags, soup);
  for (const ObjTag& tag : tags) {
    // An index below the base wraps around and is out of range too.
    const std::uint32_t a = tag.a - (tag.is_based_on_zero ? 0 : e_base);
    const std::uint32_t b = tag.b - (tag.is_based_on_zero ? 0 : e_base);
    if (a >= soup.positions.size() || (!tag.is_corner && b >= soup.positions.size())) {
      throw InputError(file.name(), file.line_of(tag.where),
                       "crease of a vertex that does not exist");
    }
    if (tag.is_corner) {
      soup.corner_tags.push_back({a, tag.sharpness});
    } else {
      soup.creases.push_back({a, b, tag.sharpness});
    }
  }
}

}  // namespace mesher::io
