#include "engine/mesh/wedges.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string_view>
#include <unordered_map>

#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"

namespace mesher {
namespace {

constexpr std::size_t kWedgeGrain = std::size_t{1} << 14;
// Beyond so many wedges of one vertex, they are found by hash.
constexpr std::size_t kMostCompared = 16;

using Streams = std::vector<AttributeStream>;

bool has_same_values(const AttributeStream& stream, std::uint32_t a, std::uint32_t b) {
  if (a == b) return true;
  if (a == kNone || b == kNone) return false;
  return std::all_of(stream.layers.begin(), stream.layers.end(), [&](const AttributeLayer& layer) {
    return std::memcmp(layer.value(a).data(), layer.value(b).data(), layer.type().value_bytes()) ==
           0;
  });
}

bool has_same_values(const Streams& streams, Halfedge a, Halfedge b) {
  return std::all_of(streams.begin(), streams.end(), [&](const AttributeStream& stream) {
    return has_same_values(stream, stream.index[a.index()], stream.index[b.index()]);
  });
}

std::size_t hash_of(const Streams& streams, Halfedge corner) {
  std::size_t hash = 0;
  const auto add = [&](std::string_view bytes) {
    hash = hash * 31 + std::hash<std::string_view>()(bytes);
  };
  for (const AttributeStream& stream : streams) {
    const std::uint32_t i = stream.index[corner.index()];
    if (i == kNone) {
      add("none");
      continue;
    }
    for (const AttributeLayer& layer : stream.layers) {
      const auto value = layer.value(i);
      add({reinterpret_cast<const char*>(value.data()), value.size()});
    }
  }
  return hash;
}

/// The wedges of one vertex, each with the first of its corners.
class VertexWedges {
 public:
  explicit VertexWedges(const Streams& streams) : streams_(streams) {}

  void clear() {
    first_.clear();
    by_hash_.clear();
  }
  /// Returns the number of a corner's wedge at its vertex.
  std::size_t add(Halfedge corner) {
    // Neighbors around a vertex mostly agree.
    if (!first_.empty() && has_same_values(streams_, corner, first_[last_])) return last_;
    return last_ = first_.size() < kMostCompared ? add_by_value(corner) : add_by_hash(corner);
  }
  /// Returns the first corner of each wedge.
  const std::vector<Halfedge>& first() const { return first_; }

 private:
  std::size_t add_by_value(Halfedge corner) {
    const auto found = std::find_if(first_.begin(), first_.end(), [&](Halfedge first) {
      return has_same_values(streams_, corner, first);
    });
    if (found != first_.end()) return static_cast<std::size_t>(found - first_.begin());
    first_.push_back(corner);
    return first_.size() - 1;
  }

  std::size_t add_by_hash(Halfedge corner) {
    if (by_hash_.empty()) {
      for (std::size_t i = 0; i < first_.size(); ++i)
        by_hash_.emplace(hash_of(streams_, first_[i]), i);
    }
    const std::size_t hash = hash_of(streams_, corner);
    const auto [begin, end] = by_hash_.equal_range(hash);
    for (auto at = begin; at != end; ++at) {
      if (has_same_values(streams_, corner, first_[at->second])) return at->second;
    }
    by_hash_.emplace(hash, first_.size());
    first_.push_back(corner);
    return first_.size() - 1;
  }

  const Streams& streams_;
  std::vector<Halfedge> first_;
  std::size_t last_ = 0;
  std::unordered_multimap<std::size_t, std::size_t> by_hash_;
};

/// Finds the wedges of all vertices in two passes over fixed chunks: the first counts, so that the
/// second knows the number of each chunk's first further wedge.
class WedgeMaker {
 public:
  WedgeMaker(const Mesh& mesh, Streams&& streams, Progress* progress)
      : mesh_(mesh), streams_(std::move(streams)), progress_(progress) {}

  Attributes run() {
    Stages stages(progress_, {1.0, 1.0, 1.0});
    stages.next();
    count_further();
    stages.next();
    number_wedges();
    stages.next();
    fill_layers();
    return std::move(result_);
  }

 private:
  template <class Visit>
  void for_each_vertex(const Visit& visit) {
    parallel_chunks(mesh_.vertex_count(), kWedgeGrain, progress_,
                    [&](std::size_t chunk, IndexRange range) {
                      VertexWedges wedges(streams_);
                      for (std::size_t v = range.begin; v < range.end; ++v) {
                        wedges.clear();
                        visit(chunk, Vertex(static_cast<std::uint32_t>(v)), wedges);
                      }
                    });
  }

  void count_further() {
    first_further_.assign(chunk_count(mesh_.vertex_count(), kWedgeGrain) + 1, 0);
    for_each_vertex([&](std::size_t chunk, Vertex v, VertexWedges& wedges) {
      for (const Halfedge h : halfedges_around(mesh_, v))
        wedges.add(h);
      if (wedges.first().size() > 1)
        first_further_[chunk + 1] += static_cast<std::uint32_t>(wedges.first().size() - 1);
    });
    std::partial_sum(first_further_.begin(), first_further_.end(), first_further_.begin());
  }

  void number_wedges() {
    corner_of_.assign(mesh_.vertex_count() + std::size_t{first_further_.back()}, Halfedge());
    if (first_further_.back() == 0) {
      for_each_vertex(
          [&](std::size_t, Vertex v, VertexWedges&) { corner_of_[v.index()] = mesh_.outgoing(v); });
      return;
    }
    result_.corner_wedge.resize(mesh_.halfedge_count());
    result_.further.resize(first_further_.back());
    std::vector<std::uint32_t> next = first_further_;
    for_each_vertex([&](std::size_t chunk, Vertex v, VertexWedges& wedges) {
      const std::uint32_t first = next[chunk];
      for (const Halfedge h : halfedges_around(mesh_, v)) {
        const auto number = static_cast<std::uint32_t>(wedges.add(h));
        result_.corner_wedge[h.index()] =
            number == 0 ? Wedge(v.index()) : Wedge(mesh_.vertex_count() + first + number - 1);
      }
      for (std::size_t i = 0; i < wedges.first().size(); ++i) {
        if (i == 0) {
          corner_of_[v.index()] = wedges.first()[0];
          continue;
        }
        result_.further[next[chunk]] = v;
        corner_of_[mesh_.vertex_count() + next[chunk]++] = wedges.first()[i];
      }
    });
  }

  void fill_layers() {
    for (const AttributeStream& stream : streams_) {
      for (const AttributeLayer& from : stream.layers) {
        AttributeLayer& to = result_.layers.emplace_back(from.type(), corner_of_.size());
        parallel_chunks(corner_of_.size(), kWedgeGrain, progress_,
                        [&](std::size_t, IndexRange range) {
                          for (std::size_t w = range.begin; w < range.end; ++w)
                            fill(to, w, stream, from);
                        });
      }
    }
  }

  void fill(AttributeLayer& to, std::size_t w, const AttributeStream& stream,
            const AttributeLayer& from) const {
    const Halfedge corner = corner_of_[w];
    const std::uint32_t i = corner.is_valid() ? stream.index[corner.index()] : kNone;
    if (i == kNone) {
      store_absent(to, w);
    } else {
      std::memcpy(to.value(w).data(), from.value(i).data(), from.type().value_bytes());
    }
  }

  const Mesh& mesh_;
  Streams streams_;
  Progress* progress_;
  Attributes result_;
  std::vector<std::uint32_t> first_further_;  ///< by chunk
  Array<Halfedge> corner_of_;                 ///< by wedge; none: an isolated vertex
};

/// Takes the layers out of the attributes.
AttributeStream stream_of(const Mesh& mesh, Attributes& attributes) {
  AttributeStream stream;
  stream.layers = std::move(attributes.layers);
  stream.index.resize(mesh.halfedge_count());
  parallel_for_each(mesh.halfedge_count(), kWedgeGrain, [&](std::uint32_t h) {
    stream.index[h] = attributes.wedge(mesh.origins(), Halfedge(h)).index();
  });
  return stream;
}

void remake(const Mesh& mesh, Attributes& attributes, Streams&& streams, Progress* progress) {
  Attributes made = make_wedges(mesh, std::move(streams), progress);
  attributes.layers = std::move(made.layers);
  attributes.corner_wedge = std::move(made.corner_wedge);
  attributes.further = std::move(made.further);
}

}  // namespace

Attributes make_wedges(const Mesh& mesh, std::vector<AttributeStream>&& streams,
                       Progress* progress) {
  std::erase_if(streams, [](const AttributeStream& stream) { return stream.layers.empty(); });
  if (streams.empty()) return {};
  return WedgeMaker(mesh, std::move(streams), progress).run();
}

void set_corner_layers(const Mesh& mesh, Attributes& attributes,
                       std::vector<AttributeLayer>&& layers, Progress* progress) {
  Streams streams(2);
  streams[0] = stream_of(mesh, attributes);
  std::erase_if(streams[0].layers, [&](const AttributeLayer& old) {
    return std::any_of(layers.begin(), layers.end(), [&](const AttributeLayer& layer) {
      return layer.type().name == old.type().name;
    });
  });
  streams[1].layers = std::move(layers);
  streams[1].index.resize(mesh.halfedge_count());
  std::iota(streams[1].index.begin(), streams[1].index.end(), 0U);
  remake(mesh, attributes, std::move(streams), progress);
}

void set_normals(const Mesh& mesh, Attributes& attributes, std::span<const glm::vec3> normals,
                 Progress* progress) {
  if (normals.empty()) return;
  std::vector<AttributeLayer> layers;
  layers.emplace_back(normal_type(), normals);
  set_corner_layers(mesh, attributes, std::move(layers), progress);
}

}  // namespace mesher
