#include "engine/mesh/build/build.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "engine/core/error.h"
#include "engine/core/face_limit.h"
#include "engine/core/parallel.h"
#include "engine/mesh/build/diagonals.h"
#include "engine/mesh/build/edge_matching.h"
#include "engine/mesh/build/manifold_cutter.h"
#include "engine/mesh/build/orientation.h"
#include "engine/mesh/build/triangulate.h"
#include "engine/mesh/wedges.h"

namespace mesher {
namespace {

constexpr std::size_t kBuildGrain = std::size_t{1} << 16;
/// Times of the stages of a build: triangulating, cleaning, matching edges, orienting and cutting,
/// sharpness. Medians of 0.1, 1.4 and 13 million triangles, and of 1 million quads, on two cores.
constexpr double kTriangleWeights[] = {0.01, 0.11, 0.58, 0.2, 0.1};
constexpr double kPolygonWeights[] = {0.42, 0.05, 0.3, 0.08, 0.15};
/// Time of the wedges, relative to the mesh: 1.4 million triangles with texture coordinates and
/// normals.
constexpr double kWedgesTime = 0.5;
// A flipped diagonal may coincide with another one in turn. If that goes on, the polygons
// themselves overlap, and their edges are cut.
constexpr int kFlipRounds = 3;

bool is_finite(const glm::vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Keeps the elements [width*i, width*(i+1)) with `drop[i] == 0`.
template <class T>
void compact(Array<T>& values, const std::vector<std::uint8_t>& drop, std::size_t width) {
  if (values.empty()) return;
  std::size_t to = 0;
  for (std::size_t i = 0; i < drop.size(); ++i) {
    if (drop[i] != 0) continue;
    for (std::size_t k = 0; k < width; ++k)
      values[to++] = values[width * i + k];
  }
  values.resize(to);
}

void set_flag(std::uint8_t& flag) {
  std::atomic_ref<std::uint8_t>(flag).store(1, std::memory_order_relaxed);
}

/// The stages of build_mesh, in order, over the data they share.
class Builder {
 public:
  Builder(Soup&& soup, const BuildOptions& options) : soup_(std::move(soup)), options_(options) {
    result_.report = soup_.report;
  }

  BuildResult run() {
    begin_stage(options_.progress, "building the mesh");
    check_sizes();
    to_streams(soup_);
    Stages stages(options_.progress, {1.0, soup_.streams.empty() ? 0.0 : kWedgesTime});
    stages.next();
    build();
    stages.next();
    result_.attributes = make_wedges(result_.mesh, std::move(soup_.streams), options_.progress);
    result_.attributes.group = std::move(soup_.attributes.group);
    result_.attributes.groups = std::move(soup_.attributes.groups);
    return std::move(result_);
  }

 private:
  /// Makes the mesh. Whatever moves corners moves the indices of the streams with them.
  void build() {
    Progress* const progress = options_.progress;
    Stages stages(progress, soup_.face_start.empty() ? std::span<const double>(kTriangleWeights)
                                                     : std::span<const double>(kPolygonWeights));
    stages.next();
    file_vertices_ = soup_.positions.size();
    copies_ = triangulate(soup_, result_.report, progress);
    check_triangle_count();
    stages.next();
    clean();
    stages.next();
    EdgeMatching matching = match_and_drop_duplicates();
    stages.next();
    orient(matching);
    ManifoldCutter(arrays_, result_.vertex_source, result_.report)
        .run(std::move(matching), progress);
    stages.next();
    arrays_.sharpness.resize(arrays_.origin.size());
    std::fill(arrays_.sharpness.begin(), arrays_.sharpness.end(), 0.0F);
    tag_creases();
    tag_corners();
    result_.mesh = std::move(arrays_).finish();
  }

  /// Drops what cannot be used, and takes positions and corners over.
  void clean() {
    Stages stages(options_.progress, {0.34, 0.42, 0.24});
    stages.next();
    drop_unusable_faces();
    stages.next();
    drop_unused_vertices();
    stages.next();
    take_corners();
    arrays_.position = std::move(soup_.positions);
  }

  void check_sizes() const {
    FaceLimit::check(soup_.face_count());
    if (soup_.positions.size() >= kNone) throw InputError("too many vertices for 32-bit ids");
    if (soup_.corners.size() >= kNone) throw InputError("too many face corners for 32-bit ids");
    if (!soup_.face_start.empty()) {
      if (soup_.face_start.front() != 0 || soup_.face_start.back() != soup_.corners.size() ||
          !std::is_sorted(soup_.face_start.begin(), soup_.face_start.end())) {
        throw InputError("face offsets do not cover the corners");
      }
    } else if (soup_.corners.size() % 3 != 0) {
      throw InputError("the number of corners is not a multiple of three");
    }
    check_attribute_sizes();
    const std::size_t vertices = soup_.positions.size();
    std::atomic<bool> is_out_of_range{false};
    parallel_chunks(soup_.corners.size(), kBuildGrain, options_.progress,
                    [&](std::size_t, IndexRange range) {
                      std::uint32_t highest = 0;
                      for (std::size_t i = range.begin; i < range.end; ++i) {
                        highest = std::max(highest, soup_.corners[i]);
                      }
                      if (range.size() > 0 && highest >= vertices) is_out_of_range = true;
                    });
    if (is_out_of_range) throw InputError("a face uses a vertex that does not exist");
  }

  void check_attribute_sizes() const {
    const CornerAttributes& a = soup_.attributes;
    const std::size_t corners = soup_.corners.size();
    for (const std::size_t size : {a.texcoord.size(), a.normal.size(), a.color.size()}) {
      if (size != 0 && size != corners)
        throw InputError("the number of attributes differs from the number of corners");
    }
    for (const AttributeStream& stream : soup_.streams)
      check_stream(stream);
    if (!a.group.empty() && a.group.size() != soup_.face_count()) {
      throw InputError("the number of groups differs from the number of faces");
    }
  }

  void check_stream(const AttributeStream& stream) const {
    if (stream.index.size() != soup_.corners.size())
      throw InputError("the number of attributes differs from the number of corners");
    for (const AttributeLayer& layer : stream.layers) {
      if (layer.count() != stream.count()) throw InputError("attributes differ in number");
    }
    for (const std::uint32_t i : stream.index) {
      if (i != kNone && i >= stream.count())
        throw InputError("a face uses an attribute that does not exist");
    }
  }

  void check_triangle_count() const {
    FaceLimit::check(soup_.corners.size() / 3);
    if (soup_.corners.size() >= kNone) throw InputError("too many triangles for 32-bit ids");
  }

  void drop_faces(const std::vector<std::uint8_t>& drop) {
    compact(soup_.corners, drop, 3);
    compact(arrays_.origin, drop, 3);
    for (AttributeStream& stream : soup_.streams)
      compact(stream.index, drop, 3);
    compact(soup_.attributes.group, drop, 1);
    compact(soup_.polygon_of, drop, 1);
  }

  void drop_unusable_faces() {
    const std::size_t faces = soup_.corners.size() / 3;
    const auto& p = soup_.positions;
    bad_vertex_.assign(p.size(), 0);
    std::atomic<std::uint64_t> bad_vertices{0};
    parallel_for(p.size(), kBuildGrain, [&](IndexRange range) {
      std::uint64_t bad = 0;
      for (std::size_t v = range.begin; v < range.end; ++v) {
        bad_vertex_[v] = is_finite(p[v]) ? 0 : 1;
        bad += bad_vertex_[v];
      }
      bad_vertices += bad;
    });
    std::vector<std::uint8_t> drop(faces, 0);
    std::atomic<std::uint64_t> degenerate{0};
    std::atomic<std::uint64_t> non_finite{0};
    parallel_chunks(faces, kBuildGrain, options_.progress, [&](std::size_t, IndexRange range) {
      for (std::size_t f = range.begin; f < range.end; ++f) {
        const std::uint32_t a = soup_.corners[3 * f];
        const std::uint32_t b = soup_.corners[3 * f + 1];
        const std::uint32_t c = soup_.corners[3 * f + 2];
        const bool is_degenerate = a == b || b == c || c == a;
        const bool is_bad = bad_vertices != 0 && (bad_vertex_[a] | bad_vertex_[b] | bad_vertex_[c]);
        drop[f] = is_degenerate || is_bad ? 1 : 0;
        if (is_degenerate) {
          ++degenerate;
        } else if (is_bad) {
          ++non_finite;
        }
      }
    });
    result_.report[Repair::non_finite_vertices_dropped] = bad_vertices;
    result_.report[Repair::non_finite_faces_dropped] = non_finite;
    result_.report[Repair::degenerate_faces_dropped] += degenerate;
    if (degenerate + non_finite > 0) drop_faces(drop);
  }

  void drop_unused_vertices() {
    const std::size_t vertices = soup_.positions.size();
    std::vector<std::uint8_t> is_used(vertices, 0);
    parallel_chunks(soup_.corners.size(), kBuildGrain, options_.progress,
                    [&](std::size_t, IndexRange range) {
                      for (std::size_t i = range.begin; i < range.end; ++i)
                        set_flag(is_used[soup_.corners[i]]);
                    });
    std::vector<std::uint8_t> drop(vertices, 0);
    std::uint64_t isolated = 0;
    bool drops_any = false;
    for (std::size_t v = 0; v < vertices; ++v) {
      const bool is_isolated = is_used[v] == 0 && bad_vertex_[v] == 0;
      isolated += is_isolated ? 1 : 0;
      drop[v] = bad_vertex_[v] != 0 || (is_isolated && !options_.keep_isolated_vertices) ? 1 : 0;
      drops_any |= drop[v] != 0;
    }
    bad_vertex_ = {};
    result_.report[options_.keep_isolated_vertices ? Repair::isolated_vertices_kept
                                                   : Repair::isolated_vertices_dropped] = isolated;
    result_.vertex_source.resize(vertices);
    std::iota(result_.vertex_source.begin(), result_.vertex_source.end(), 0U);
    if (!drops_any) return find_copies();
    Array<std::uint32_t> new_index(vertices);
    std::uint32_t next = 0;
    for (std::size_t v = 0; v < vertices; ++v)
      new_index[v] = drop[v] != 0 ? kNone : next++;
    compact(soup_.positions, drop, 1);
    compact(result_.vertex_source, drop, 1);
    parallel_chunks(soup_.corners.size(), kBuildGrain, options_.progress,
                    [&](std::size_t, IndexRange range) {
                      for (std::size_t i = range.begin; i < range.end; ++i)
                        soup_.corners[i] = new_index[soup_.corners[i]];
                    });
    find_copies();
  }

  /// The vertices of second sides have the source of those that they are copies of.
  void find_copies() {
    for (std::uint32_t v = 0; v < result_.vertex_source.size() && !copies_.empty(); ++v) {
      std::uint32_t& source = result_.vertex_source[v];
      if (source < file_vertices_) continue;
      const SheetCopy& copy = copies_[source - file_vertices_];
      source = copy.vertex;
      sheet_vertices_.set(copy.vertex, copy.sheet, v);
    }
  }

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(arrays_.position.size()); }

  EdgeMatching match_and_flip_diagonals() {
    EdgeMatching matching = match_edges(arrays_.origin, vertex_count(), options_.progress);
    for (int round = 0; round < kFlipRounds; ++round) {
      const std::vector<Diagonal> diagonals =
          crowded_diagonals(arrays_.origin, matching, soup_.polygon_of);
      if (diagonals.empty()) break;
      for (const Diagonal& diagonal : diagonals) {
        flip_diagonal(diagonal, arrays_.origin);
        for (AttributeStream& stream : soup_.streams)
          flip_diagonal(diagonal, stream.index);
      }
      matching = {};
      matching = match_edges(arrays_.origin, vertex_count(), options_.progress);
    }
    soup_.polygon_of = {};
    return matching;
  }

  EdgeMatching match_and_drop_duplicates() {
    EdgeMatching matching = match_and_flip_diagonals();
    // Polygons and triangles share the vertices of their sheet, so that a two-sided surface of both
    // holds together. If such a face coincides with another one in turn, it gets new vertices.
    for (bool shares = true; !matching.coincident_faces.empty(); shares = false) {
      const CoincidentFaces found =
          coincident_triangles(arrays_.origin, matching.coincident_faces, soup_.attributes.group);
      matching = {};
      SheetVertices new_vertices;
      for (const SecondSide& side : found.second_sides)
        separate(side, shares ? sheet_vertices_ : new_vertices, shares);
      result_.report[Repair::second_sides_kept] += shares ? found.second_sides.size() : 0;
      result_.report[Repair::duplicate_faces_dropped] += found.duplicates.size();
      drop_duplicates(found.duplicates);
      matching = match_edges(arrays_.origin, vertex_count(), options_.progress);
    }
    return matching;
  }

  void drop_duplicates(const std::vector<std::uint32_t>& duplicates) {
    if (duplicates.empty()) return;
    std::vector<std::uint8_t> drop(arrays_.origin.size() / 3, 0);
    for (const std::uint32_t f : duplicates)
      drop[f] = 1;
    drop_faces(drop);
  }

  /// Gives a second side vertices of its own, the copies of its vertices or of their sources.
  void separate(const SecondSide& side, SheetVertices& vertices, bool of_sources) {
    for (std::size_t c = 0; c < 3; ++c) {
      Vertex& v = arrays_.origin[3 * std::size_t{side.face} + c];
      const std::uint32_t source = result_.vertex_source[v.index()];
      const std::uint32_t next = vertex_count();
      if (next >= kNone - 1) throw InputError("too many vertices for 32-bit ids");
      const std::uint32_t copy = vertices.copy(of_sources ? source : v.index(), side.sheet, next);
      if (copy == next) {
        arrays_.position.push_back(glm::vec3(arrays_.position[v.index()]));
        result_.vertex_source.push_back(source);
      }
      v = Vertex(copy);
    }
  }

  void orient(EdgeMatching& matching) {
    if (matching.disagreeing_edges == 0) return;
    const std::vector<std::uint32_t> flips =
        faces_to_flip(arrays_.origin, matching, options_.progress);
    result_.report[Repair::faces_flipped] = flips.size();
    for (const std::uint32_t f : flips)
      flip(f);
    flip_faces(matching, arrays_.origin, flips);
  }

  void flip(std::uint32_t f) {
    const auto swap_corners = [&](auto& values) {
      if (!values.empty())
        std::swap(values[3 * std::size_t{f} + 1], values[3 * std::size_t{f} + 2]);
    };
    swap_corners(arrays_.origin);
    for (AttributeStream& stream : soup_.streams) {
      swap_corners(stream.index);
      turn_normals(f, stream);
    }
  }

  /// Gives the corners of a flipped face normals that point to its front. Either only the winding
  /// was wrong, or the normals were reversed too: the face normal tells which.
  void turn_normals(std::uint32_t f, AttributeStream& stream) const {
    const auto layer = std::find_if(
        stream.layers.begin(), stream.layers.end(),
        [](const AttributeLayer& l) { return l.type().kind == AttributeKind::normal; });
    if (layer == stream.layers.end()) return;
    const glm::dvec3 face = face_normal(f);
    for (std::size_t c = 3 * std::size_t{f}; c < 3 * std::size_t{f} + 3; ++c) {
      std::uint32_t& i = stream.index[c];
      if (i == kNone) continue;
      const AttributeValue n = load(*layer, i);
      if (!(glm::dot(glm::dvec3(n[0], n[1], n[2]), face) < 0.0)) continue;
      i = append_turned(stream, i);
    }
  }

  /// Appends a copy of a value, whose normal points the other way, to all layers of a stream, since
  /// other faces may use the original. Returns its index.
  static std::uint32_t append_turned(AttributeStream& stream, std::uint32_t i) {
    const auto turned = static_cast<std::uint32_t>(stream.count());
    for (AttributeLayer& layer : stream.layers) {
      layer.resize(turned + std::size_t{1});
      AttributeValue value = load(layer, i);
      const AttributeKind kind = layer.type().kind;
      if (kind == AttributeKind::normal) {
        for (double& x : value)
          x = -x;
      } else if (kind == AttributeKind::tangent) {
        value[3] = -value[3];  // of the bitangent, which stays
      }
      store(layer, turned, value);
    }
    return turned;
  }

  glm::dvec3 face_normal(std::uint32_t f) const {
    const auto corner = [&](std::size_t c) {
      return glm::dvec3(arrays_.position[arrays_.origin[3 * std::size_t{f} + c].index()]);
    };
    return glm::cross(corner(1) - corner(0), corner(2) - corner(0));
  }

  void take_corners() {
    arrays_.origin.resize(soup_.corners.size());
    parallel_chunks(soup_.corners.size(), kBuildGrain, options_.progress,
                    [&](std::size_t, IndexRange range) {
                      for (std::size_t i = range.begin; i < range.end; ++i)
                        arrays_.origin[i] = Vertex(soup_.corners[i]);
                    });
    soup_.corners = {};
  }

  static bool is_usable(float sharpness) { return sharpness >= 0.0F; }

  /// Returns the tags sorted by file vertices, one per edge: the last one in the file.
  std::vector<CreaseTag> sorted_tags() {
    std::vector<CreaseTag> tags;
    for (CreaseTag tag : soup_.creases) {
      if (!is_usable(tag.sharpness)) {
        ++result_.report[Repair::invalid_sharpness_ignored];
        continue;
      }
      if (tag.a > tag.b) std::swap(tag.a, tag.b);
      tags.push_back(tag);
    }
    std::stable_sort(tags.begin(), tags.end(), [](const CreaseTag& x, const CreaseTag& y) {
      return x.a != y.a ? x.a < y.a : x.b < y.b;
    });
    std::vector<CreaseTag> unique;
    for (const CreaseTag& tag : tags) {
      if (!unique.empty() && unique.back().a == tag.a && unique.back().b == tag.b) {
        if (unique.back().sharpness != tag.sharpness) {
          ++result_.report[Repair::contradictory_creases];
        }
        unique.back().sharpness = tag.sharpness;
      } else {
        unique.push_back(tag);
      }
    }
    return unique;
  }

  void tag_creases() {
    if (soup_.creases.empty()) return;
    const std::vector<CreaseTag> tags = sorted_tags();
    const auto& source = result_.vertex_source;
    const std::uint32_t source_count =
        source.empty() ? 0 : 1 + *std::max_element(source.begin(), source.end());
    std::vector<std::uint32_t> first(std::size_t{source_count} + 1, 0);
    for (const CreaseTag& tag : tags) {
      if (tag.a < source_count) ++first[tag.a + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint8_t> is_found(tags.size(), 0);
    parallel_for(arrays_.origin.size(), kBuildGrain, [&](IndexRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const Halfedge h(static_cast<std::uint32_t>(i));
        const auto [a, b] = std::minmax(source[arrays_.origin[i].index()],
                                        source[arrays_.origin[Mesh::next(h).index()].index()]);
        const auto begin = tags.begin() + first[a];
        const auto end = tags.begin() + first[a + 1];
        const auto tag = std::lower_bound(
            begin, end, b, [](const CreaseTag& t, std::uint32_t value) { return t.b < value; });
        if (tag == end || tag->b != b) continue;
        arrays_.sharpness[i] = tag->sharpness;
        set_flag(is_found[static_cast<std::size_t>(tag - tags.begin())]);
      }
    });
    result_.report[Repair::creases_on_missing_edges] +=
        static_cast<std::uint64_t>(std::count(is_found.begin(), is_found.end(), 0));
  }

  void tag_corners() {
    if (soup_.corner_tags.empty()) return;
    const auto& source = result_.vertex_source;
    const std::uint32_t source_count =
        source.empty() ? 0 : 1 + *std::max_element(source.begin(), source.end());
    std::vector<float> own(source_count, 0.0F);
    for (const CornerTag& tag : soup_.corner_tags) {
      if (!is_usable(tag.sharpness)) {
        ++result_.report[Repair::invalid_sharpness_ignored];
      } else if (tag.v < source_count) {
        own[tag.v] = tag.sharpness;
      } else {
        ++result_.report[Repair::creases_on_missing_edges];
      }
    }
    arrays_.vertex_sharpness.resize(source.size());
    for (std::size_t v = 0; v < source.size(); ++v)
      arrays_.vertex_sharpness[v] = own[source[v]];
  }

  Soup soup_;
  BuildOptions options_;
  BuildResult result_;
  MeshArrays arrays_;
  std::vector<std::uint8_t> bad_vertex_;
  std::size_t file_vertices_ = 0;
  std::vector<SheetCopy> copies_;  ///< the vertices after those of the file
  SheetVertices sheet_vertices_;   ///< by source and sheet
};

}  // namespace

BuildResult build_mesh(Soup&& soup, const BuildOptions& options) {
  return Builder(std::move(soup), options).run();
}

}  // namespace mesher
