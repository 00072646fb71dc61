#include "engine/progressive/codec/pm_base.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "engine/mesh/build/edge_matching.h"
#include "engine/progressive/codec/range_coder.h"
#include "engine/progressive/codec/sharpness_coder.h"

namespace mesher::progressive {
namespace {

/// Encodes or decodes a base. A decoder lets the arrays grow with what has been decoded, because
/// the header may announce anything.
template <class Coder>
class BaseCoder {
 public:
  BaseCoder(const PmHeader& header, PmBase& base, Coder& coder)
      : header_(header), base_(base), coder_(coder) {}

  std::string_view code_faces() {
    Array<Vertex>& origin = base_.arrays.origin;
    for (std::size_t h = 0; h < 3 * std::size_t{header_.base_faces}; ++h) {
      if constexpr (Coder::kDecodes) origin.push_back(Vertex(0));
      const std::uint32_t v = code_corner(h, origin[h].index());
      if (v >= header_.base_vertices) return "a face of the base has a vertex that is not there";
      origin[h] = Vertex(v);
      next_ = std::max(next_, v + 1);
    }
    return {};
  }

  std::string_view code_positions() {
    const Array<std::uint32_t> neighbor = neighbors();
    for (std::uint32_t v = 0; v < header_.base_vertices; ++v) {
      if constexpr (Coder::kDecodes) add_vertex();
      const std::uint32_t before = v == 0 ? kNone : v - 1;
      const std::uint32_t near = v < neighbor.size() && neighbor[v] != kNone ? neighbor[v] : before;
      const bool is_good = header_.is_quantized() ? code_numbers(v, near) : code_floats(v, near);
      if (!is_good) return "a vertex of the base is outside the range of coordinates";
    }
    return {};
  }

  std::string_view code_sharpness() {
    MeshArrays& a = base_.arrays;
    if constexpr (Coder::kDecodes) {
      a.sharpness.assign(a.origin.size(), 0.0F);
      if (header_.has_sharp_vertices()) a.vertex_sharpness.assign(a.position.size(), 0.0F);
    }
    bool is_good = true;
    for (std::size_t h = 0; header_.has_sharp_edges() && h < a.origin.size(); ++h) {
      const Halfedge twin = a.twin[h];
      if (twin.is_valid() && twin.index() < h) {
        a.sharpness[h] = a.sharpness[twin.index()];
      } else {
        a.sharpness[h] = edge_.code(coder_, a.sharpness[h]);
        is_good = is_good && is_sharpness(a.sharpness[h]);
      }
    }
    for (float& own : a.vertex_sharpness) {
      own = corner_.code(coder_, own);
      is_good = is_good && is_sharpness(own);
    }
    return is_good ? std::string_view{} : "a sharpness of the base is not a number from 0 on";
  }

 private:
  static constexpr std::uint32_t kNext = 0;
  static constexpr std::uint32_t kElsewhere = 7;

  /// Vertex that a code stands for: 0 is the lowest vertex not seen yet, 1 to 6 are the corners of
  /// the two faces before, 7 is a difference.
  std::uint32_t candidate(std::size_t h, std::uint32_t which) const {
    if (which == kNext) return next_;
    const std::size_t face = h - h % 3;
    const std::size_t back = which <= 3 ? 3 : 6;
    return face < back ? kNone : base_.arrays.origin[face - back + (which - 1) % 3].index();
  }

  std::uint32_t code_corner(std::size_t h, std::uint32_t v) {
    const std::size_t corner = h % 3;
    std::uint32_t which = 0;
    if constexpr (!Coder::kDecodes) {
      while (which < kElsewhere && candidate(h, which) != v)
        ++which;
    }
    which = which_[8 * corner + last_which_].code(coder_, which);
    last_which_ = which;
    if (which < kElsewhere) return candidate(h, which);
    const std::size_t from = corner == 0 ? (h == 0 ? 0 : h - 3) : h - corner;
    const std::int64_t before = h == 0 ? 0 : base_.arrays.origin[from].index();
    const std::int64_t result = before + difference_[corner].code(coder_, std::int64_t{v} - before);
    return result < 0 || result >= kNone ? kNone : static_cast<std::uint32_t>(result);
  }

  void add_vertex() {
    base_.arrays.position.push_back(glm::vec3(0.0F));
    if (header_.is_quantized()) base_.grid.push_back(glm::ivec3(0));
  }

  /// Returns, by vertex of a face, the highest lower vertex that shares a face with it, or kNone.
  Array<std::uint32_t> neighbors() const {
    Array<std::uint32_t> near;
    near.assign(next_, kNone);
    const Array<Vertex>& origin = base_.arrays.origin;
    for (std::size_t h = 0; h < origin.size(); ++h) {
      const std::size_t face = h - h % 3;
      const std::uint32_t v = origin[h].index();
      for (std::size_t other = face; other < face + 3; ++other) {
        const std::uint32_t u = origin[other].index();
        if (u < v && (near[v] == kNone || near[v] < u)) near[v] = u;
      }
    }
    return near;
  }

  bool code_numbers(std::uint32_t v, std::uint32_t near) {
    const std::int64_t highest = (std::int64_t{1} << header_.coordinate_bits) - 1;
    for (int i = 0; i < 3; ++i) {
      const std::int64_t before = near == kNone ? 0 : base_.grid[near][i];
      const std::int64_t number = before + position_[i].code(coder_, base_.grid[v][i] - before);
      if (number < 0 || number > highest) return false;
      base_.grid[v][i] = static_cast<int>(number);
    }
    base_.arrays.position[v] = header_.grid.position(base_.grid[v]);
    return true;
  }

  bool code_floats(std::uint32_t v, std::uint32_t near) {
    Array<glm::vec3>& position = base_.arrays.position;
    for (int i = 0; i < 3; ++i) {
      const std::int64_t before = near == kNone ? 0 : pm_ordered(position[near][i]);
      const std::int64_t difference = Coder::kDecodes ? 0 : pm_ordered(position[v][i]) - before;
      const std::int64_t number = before + position_[i].code(coder_, difference);
      if (!is_finite_ordered(number)) return false;
      position[v][i] = pm_float(static_cast<std::int32_t>(number));
    }
    return true;
  }

  const PmHeader& header_;
  PmBase& base_;
  Coder& coder_;
  std::uint32_t next_ = 0;
  std::uint32_t last_which_ = 0;
  BitTreeModel<3> which_[24];
  SignedIntegerCoder difference_[3];
  SignedIntegerCoder position_[3];
  SharpnessCoder edge_;
  SharpnessCoder corner_;
};

/// Finds twins. Returns whether no face uses a vertex twice and no edge is used twice in one
/// direction.
bool find_twins(MeshArrays& arrays) {
  std::uint32_t vertices_of_faces = 0;
  for (const Vertex v : arrays.origin)
    vertices_of_faces = std::max(vertices_of_faces, v.index() + 1);
  for (std::size_t h = 0; h < arrays.origin.size(); h += 3) {
    const Vertex* v = &arrays.origin[h];
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return false;
  }
  // The vertices after those of the faces have no edges.
  EdgeMatching matching = match_edges(arrays.origin, vertices_of_faces);
  arrays.twin = std::move(matching.twin);
  return matching.disagreeing_edges == 0 && matching.crowded.empty() &&
         matching.coincident_faces.empty();
}

}  // namespace

Array<std::byte> encode_base(const PmHeader& header, const PmBase& base) {
  RangeEncoder encoder;
  PmBase copy = base;
  BaseCoder<RangeEncoder> coder(header, copy, encoder);
  coder.code_faces();
  coder.code_positions();
  coder.code_sharpness();
  return encoder.finish(pm_least_base_bytes(std::max(header.base_vertices, header.base_faces)));
}

std::string_view decode_base(const PmHeader& header, std::span<const std::byte> payload,
                             PmBase& base) {
  RangeDecoder decoder(payload);
  BaseCoder<RangeDecoder> coder(header, base, decoder);
  if (const auto why = coder.code_faces(); !why.empty()) return why;
  if (!find_twins(base.arrays)) return "the faces of the base are not those of a surface";
  if (const auto why = coder.code_positions(); !why.empty()) return why;
  return coder.code_sharpness();
}

}  // namespace mesher::progressive
