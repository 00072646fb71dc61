#include "engine/progressive/split_coder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/vec3.hpp>
#include <limits>
#include <utility>

#include "engine/progressive/sharpness_model.h"
#include "engine/progressive/split_ring.h"

namespace mesher {
namespace {

/// Highest number of slots whose choice is learned.
constexpr std::uint32_t kFewSlots = 16;

/// Which edges at the parent open.
class CutModel {
 public:
  template <class Coder>
  SplitCut code(Coder& coder, const SplitRing& ring, SplitCut cut) {
    const std::uint32_t slots = ring.slots();
    const bool is_pair = ring.is_closed() || coder.bit(is_pair_, cut.right != kNone);
    cut.left = code_slot(coder, left_[2 * few(slots) + (is_pair ? 1U : 0U)], cut.left, slots);
    if (!is_pair) return {cut.left, kNone};
    const std::uint32_t distance = cut.right + (cut.right < cut.left ? slots : 0U) - cut.left;
    const std::uint32_t told = code_slot(coder, distance_[few(slots)], distance - 1, slots - 1) + 1;
    return {cut.left, (cut.left + told) % slots};
  }

 private:
  static std::uint32_t few(std::uint32_t slots) { return std::min(slots, kFewSlots); }

  /// A number below `count`; a higher one is no lie that an encoder tells.
  template <class Coder>
  std::uint32_t code_slot(Coder& coder, BitTree<4>& model, std::uint32_t slot,
                          std::uint32_t count) {
    if (count > kFewSlots) return coder.uniform(slot, count);
    return std::min(model.code(coder, slot), count - 1);
  }

  BitModel is_pair_;
  BitTree<4> left_[2 * (kFewSlots + 1)];
  BitTree<4> distance_[kFewSlots + 1];
};

/// The middles of what will be around parent and child, with the vertices of the edges that open.
struct Sides {
  glm::dvec3 parent{0.0};
  glm::dvec3 child{0.0};

  template <class Position>
  Sides(const SplitRing& ring, const SplitCut& cut, const Position& position) {
    const std::uint32_t last = ring.slots() - 1;
    if (cut.right == kNone) {
      child = mean(ring, cut.left, last, position);
      parent = mean(ring, 0, cut.left, position);
    } else {
      child = mean(ring, cut.left, cut.right, position);
      parent = mean(ring, cut.right, cut.left, position);
    }
  }

 private:
  template <class Position>
  static glm::dvec3 mean(const SplitRing& ring, std::uint32_t begin, std::uint32_t end,
                         const Position& position) {
    glm::dvec3 sum = position(ring.vertex(begin));
    double count = 1.0;
    for (std::uint32_t slot = begin; slot != end; count += 1.0) {
      slot = slot + 1 == ring.slots() ? 0 : slot + 1;
      sum += position(ring.vertex(slot));
    }
    return sum / count;
  }
};

int exponent(double value) {
  return static_cast<int>(std::bit_cast<std::uint64_t>(value) >> 52U & 0x7FFU);
}

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

constexpr std::size_t kContexts = 40;

std::size_t context(int value) {
  return static_cast<std::size_t>(std::clamp(value, 0, static_cast<int>(kContexts) - 1));
}

/// Positions as floats, exactly.
class FloatPlaces {
 public:
  template <class Coder>
  bool code(Coder& coder, const Mesh& mesh, const SplitRing& ring, NewSplit& split) {
    const auto position = [&](Vertex v) { return glm::dvec3(mesh.position(v)); };
    const glm::dvec3 at = position(split.parent);
    const Sides sides(ring, split.cut, position);
    const glm::dvec3 p = sides.parent - at;
    const glm::dvec3 c = sides.child - at;
    const int scale = exponent(largest(p) + largest(c));
    bool is_good =
        code_one(coder, parent_, at + 0.53125 * p - 0.09375 * c, scale, split.parent_position);
    const glm::dvec3 moved = glm::dvec3(split.parent_position) - at;
    const glm::dvec3 guess = at + 0.125 * moved - 0.1875 * p + 0.484375 * c;
    is_good = is_good && code_one(coder, child_, guess, scale, split.child_position);
    return is_good;
  }

 private:
  using Model = SignedModel<6>;

  template <class Coder>
  static bool code_one(Coder& coder, Model* models, const glm::dvec3& guess, int scale,
                       glm::vec3& position) {
    for (int i = 0; i < 3; ++i) {
      constexpr double most = std::numeric_limits<float>::max();
      const double near = std::clamp(guess[i], -most, most);
      const std::int64_t before = pm_ordered(static_cast<float>(near));
      // How many units of the last place the surroundings measure.
      const std::size_t size = context(scale - exponent(near) + 24);
      const std::int64_t difference = Coder::kDecodes ? 0 : pm_ordered(position[i]) - before;
      const std::int64_t number = before + models[size].code(coder, difference);
      if (!is_finite_ordered(number)) return false;
      position[i] = pm_float(static_cast<std::int32_t>(number));
    }
    return true;
  }

  Model parent_[kContexts];
  Model child_[kContexts];
};

/// Positions on a grid.
class GridPlaces {
 public:
  explicit GridPlaces(Array<glm::ivec3>&& numbers) : numbers_(std::move(numbers)) {}

  template <class Coder>
  bool code(Coder& coder, const PmHeader& header, const SplitRing& ring, NewSplit& split) {
    const auto position = [&](Vertex v) { return glm::dvec3(numbers_[v.index()]); };
    const glm::dvec3 at = position(split.parent);
    const Sides sides(ring, split.cut, position);
    const glm::dvec3 p = sides.parent - at;
    const glm::dvec3 c = sides.child - at;
    const glm::dvec3 across = c - p;
    const std::size_t size = context(exponent(dot(across, across)) - 1023);
    glm::ivec3 parent(0);
    glm::ivec3 child(0);
    if constexpr (!Coder::kDecodes) {
      parent = header.grid.numbers(split.parent_position, header.coordinate_bits);
      child = header.grid.numbers(split.child_position, header.coordinate_bits);
    }
    const int highest = (1 << header.coordinate_bits) - 1;
    if (!code_one(coder, parent_[size], at + 0.53125 * p - 0.09375 * c, highest, parent))
      return false;
    const glm::dvec3 moved = glm::dvec3(parent) - at;
    const glm::dvec3 guess = at + 0.125 * moved - 0.1875 * p + 0.484375 * c;
    if (!code_one(coder, child_[size], guess, highest, child)) return false;
    numbers_[split.parent.index()] = parent;
    numbers_.push_back(child);
    split.parent_position = header.grid.position(parent);
    split.child_position = header.grid.position(child);
    return true;
  }

 private:
  using Model = SignedModel<5>;

  static double dot(const glm::dvec3& a, const glm::dvec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }

  template <class Coder>
  static bool code_one(Coder& coder, Model& model, const glm::dvec3& guess, int highest,
                       glm::ivec3& numbers) {
    for (int i = 0; i < 3; ++i) {
      const auto before = static_cast<std::int64_t>(std::floor(guess[i] + 0.5));
      const std::int64_t number = before + model.code(coder, numbers[i] - before);
      if (number < 0 || number > highest) return false;
      numbers[i] = static_cast<int>(number);
    }
    return true;
  }

  Array<glm::ivec3> numbers_;
  Model parent_[kContexts];
  Model child_[kContexts];
};

/// How sharp the edges are that a split makes and those that it opens.
class SharpSplitModel {
 public:
  template <class Coder>
  std::string_view code(Coder& coder, const Mesh& mesh, const SplitRing& ring, NewSplit& split) {
    SplitSharpness& s = split.sharpness;
    s.edge = edge_.code(coder, s.edge);
    bool is_good = is_sharpness(s.edge);
    is_good &=
        code_side(coder, mesh.sharpness(ring.halfedge(split.cut.left)), s.sides[0], s.sides[1]);
    if (split.cut.right == kNone) {
      s.sides[2] = s.sides[3] = 0.0F;
    } else {
      is_good &=
          code_side(coder, mesh.sharpness(ring.halfedge(split.cut.right)), s.sides[2], s.sides[3]);
    }
    return is_good ? std::string_view{}
                   : "the sharpness of a split is not that of the level before";
  }

 private:
  /// The larger of the two is what the edge had before.
  template <class Coder>
  bool code_side(Coder& coder, float before, float& first, float& second) {
    const bool is_first = coder.bit(has_first_[before > 0.0F], has_same_bits(first, before));
    const bool is_second =
        !is_first || coder.bit(has_second_[before > 0.0F], has_same_bits(second, before));
    first = is_first ? before : other_.code(coder, first);
    second = is_second ? before : other_.code(coder, second);
    return has_same_bits(std::max(first, second), before) && is_sharpness(first) &&
           is_sharpness(second);
  }

  SharpnessModel edge_;
  SharpnessModel other_;
  BitModel has_first_[2];
  BitModel has_second_[2];
};

/// The sharpness of parent and child themselves.
class SharpCornerModel {
 public:
  template <class Coder>
  std::string_view code(Coder& coder, const Mesh& mesh, NewSplit& split) {
    const float before = mesh.sharpness(split.parent);
    const bool is_good = code_one(coder, before, split.parent_corner_sharpness, 0) &&
                         code_one(coder, before, split.child_corner_sharpness, 1);
    return is_good ? std::string_view{} : "the sharpness of a vertex is not a number from 0 on";
  }

 private:
  template <class Coder>
  bool code_one(Coder& coder, float before, float& value, std::size_t which) {
    const bool stays =
        coder.bit(stays_[2 * which + std::size_t{before > 0.0F}], has_same_bits(value, before));
    value = stays ? before : value_.code(coder, value);
    return is_sharpness(value);
  }

  BitModel stays_[4];
  SharpnessModel value_;
};

}  // namespace

template <class Coder>
struct SplitCoder<Coder>::State {
  PmHeader header;
  SplitRing ring;
  CutModel cut;
  FloatPlaces floats;
  GridPlaces grid;
  SharpSplitModel sharpness;
  SharpCornerModel corners;
  std::uint64_t most_moved = 0;
  std::uint64_t most_walked = 0;
  std::uint64_t moved = 0;
  std::uint64_t walked = 0;

  State(const PmHeader& h, Array<glm::ivec3>&& numbers) : header(h), grid(std::move(numbers)) {}

  std::string_view code_parent(Coder& coder, const ProgressiveMesh& pm, NewSplit& split) {
    const Mesh& mesh = pm.mesh();
    if (mesh.vertex_count() == 0) return "a split has no vertex to split";
    split.parent = Vertex(coder.uniform(split.parent.index(), mesh.vertex_count()));
    if (mesh.is_isolated(split.parent)) return "a split has a parent without faces";
    if (!ring.gather(mesh, split.parent)) return "a split has a parent of too many faces";
    walked += ring.faces();
    return walked <= most_walked ? std::string_view{}
                                 : "too many faces around the parents of splits";
  }

  std::string_view code_cut(Coder& coder, const ProgressiveMesh& pm, NewSplit& split) {
    split.cut = cut.code(coder, ring, split.cut);
    if (Coder::kDecodes && !pm.can_append(split.parent, split.cut))
      return "a split cuts where it cannot";
    moved += ring.moved(split.cut);
    return moved <= most_moved ? std::string_view{} : "splits move too many corners";
  }
};

template <class Coder>
SplitCoder<Coder>::SplitCoder(const PmHeader& header, Array<glm::ivec3>&& grid)
    : state_(std::make_unique<State>(header, std::move(grid))) {}

template <class Coder>
SplitCoder<Coder>::~SplitCoder() = default;

template <class Coder>
void SplitCoder<Coder>::begin_block(std::uint64_t splits_at_end) {
  state_->most_moved = pm_most_moved(splits_at_end);
  state_->most_walked = pm_most_walked(splits_at_end);
}

template <class Coder>
std::string_view SplitCoder<Coder>::code(Coder& coder, const ProgressiveMesh& mesh,
                                         NewSplit& split) {
  State& s = *state_;
  if (const auto why = s.code_parent(coder, mesh, split); !why.empty()) return why;
  if (const auto why = s.code_cut(coder, mesh, split); !why.empty()) return why;
  const bool is_placed = s.header.is_quantized() ? s.grid.code(coder, s.header, s.ring, split)
                                                 : s.floats.code(coder, mesh.mesh(), s.ring, split);
  if (!is_placed) return "a split has a position outside the range of coordinates";
  if (s.header.has_sharp_edges()) {
    const auto why = s.sharpness.code(coder, mesh.mesh(), s.ring, split);
    if (!why.empty()) return why;
  }
  if (!s.header.has_sharp_vertices()) return {};
  return s.corners.code(coder, mesh.mesh(), split);
}

template class SplitCoder<RangeEncoder>;
template class SplitCoder<RangeDecoder>;

}  // namespace mesher
