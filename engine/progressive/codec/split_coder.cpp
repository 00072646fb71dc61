#include "engine/progressive/codec/split_coder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <type_traits>
#include <utility>

#include "engine/progressive/codec/cut_coder.h"
#include "engine/progressive/codec/parent_coder.h"
#include "engine/progressive/codec/place_coder.h"
#include "engine/progressive/codec/ring_prefetch.h"
#include "engine/progressive/codec/sharp_split_coder.h"
#include "engine/progressive/codec/split_ring.h"

namespace mesher::progressive {
namespace {

/// Predicted offset from parent to child, as a fraction of the vector between the means of their
/// future neighbors (best on scans, and about equally good on all models).
constexpr double kApart = 0.609375;

// The three steps of a point. Each gets its own code, so that their differences are resolved at
// compile time.
constexpr std::integral_constant<std::size_t, 0> kFirst;
constexpr std::integral_constant<std::size_t, 1> kSecond;
constexpr std::integral_constant<std::size_t, 2> kThird;

/// Codes positions as exact floats: first the parent, then the child.
class FloatPositionCoder {
 public:
  template <class Coder>
  bool code(Coder& coder, const Mesh& mesh, const SplitRing& ring, RingPrefetch& next,
            NewSplit& split) {
    const auto ahead = [&] {
      next.step([&](Vertex v) { __builtin_prefetch(&mesh.positions()[v.index()]); });
    };
    const SplitSides s(ring, split.cut);
    ahead();
    const glm::dvec3 apart = s.child - s.parent;
    const glm::vec3 before = mesh.position(split.parent);
    UnmovedEnd unmoved = UnmovedEnd::neither;
    if constexpr (!Coder::kDecodes) {
      if (has_same_bits(split.parent_position, before)) {
        unmoved = UnmovedEnd::parent;
      } else if (has_same_bits(split.child_position, before)) {
        unmoved = UnmovedEnd::child;
      }
    }
    unmoved = unmoved_.code(coder, unmoved);
    if (unmoved == UnmovedEnd::parent) split.parent_position = before;
    if (unmoved == UnmovedEnd::child) split.child_position = before;
    PositionPrediction prediction{.mean = 0.53125 * s.parent - 0.09375 * s.child,
                                  .normal = normal_of(s),
                                  .variance = dot(apart, apart)};
    if (unmoved == UnmovedEnd::child) prediction.mean = -kApart * apart;
    if (unmoved != UnmovedEnd::parent &&
        !code_point(coder, parent_, ring.at(), prediction, ahead, split.parent_position)) {
      return false;
    }
    if (unmoved == UnmovedEnd::child) return true;
    const glm::dvec3 parent = glm::dvec3(split.parent_position) - ring.at();
    prediction.mean = 0.125 * parent - 0.1875 * s.parent + 0.484375 * s.child;
    if (unmoved == UnmovedEnd::parent) {
      prediction.mean = kApart * apart;
    } else {
      use_plane(prediction, s.child_normal + cross(s.opening, parent),
                -dot(parent, s.parent_normal));
    }
    return code_point(coder, child_, ring.at(), prediction, ahead, split.child_position);
  }

 private:
  static bool has_same_bits(const glm::vec3& a, const glm::vec3& b) {
    return pm_ordered(a.x) == pm_ordered(b.x) && pm_ordered(a.y) == pm_ordered(b.y) &&
           pm_ordered(a.z) == pm_ordered(b.z);
  }

  /// Returns the biased double exponent of a float's last place near `value`, plus 23.
  static int fineness(double value) {
    constexpr int least = 1023 - 126;
    return std::max(exponent_of(value), least);
  }

  template <class Coder, class Ahead>
  static bool code_point(Coder& coder, ResidualCoder& model, const glm::dvec3& at,
                         const PositionPrediction& prediction, const Ahead& ahead,
                         glm::vec3& position) {
    const CoordinateOrder order(prediction);
    const double largest = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)});
    const Coordinates from = order.by_step(at);
    const std::array<float, 3> actual{position.x, position.y, position.z};
    std::array<float, 3> coded{};
    Coordinates point{};
    const auto code_step = [&]<std::size_t kStep>(std::integral_constant<std::size_t, kStep>) {
      ahead();
      const auto axis = static_cast<std::size_t>(order.axis(kStep));
      const double near = clamped(from[kStep] + order.mean<kStep>(point));
      const int fine = fineness(near);
      const int width = (exponent_of(order.variance(kStep)) + 1023 + 46 - 2 * fine) / 2;
      const int shift = std::clamp(fineness(largest) - fine, 0, 15);
      const std::int64_t before = pm_ordered(static_cast<float>(near));
      const std::int64_t difference = Coder::kDecodes ? 0 : pm_ordered(actual[axis]) - before;
      const std::int64_t number = before + model.template code<kStep>(coder, prediction.has_plane,
                                                                      width, shift, difference);
      if (!is_finite_ordered(number)) return false;
      coded[axis] = pm_float(static_cast<std::int32_t>(number));
      point[kStep] = double{coded[axis]} - from[kStep];
      return true;
    };
    if (!code_step(kFirst) || !code_step(kSecond) || !code_step(kThird)) return false;
    position = {coded[0], coded[1], coded[2]};
    return true;
  }

  static double clamped(double value) {
    constexpr double most = std::numeric_limits<float>::max();
    return value >= -most ? std::min(value, most) : value < -most ? -most : 0.0;
  }

  UnmovedEndCoder unmoved_;
  ResidualCoder parent_;
  ResidualCoder child_;
};

/// Codes positions on a grid: first the offset of the child from the parent, then the parent.
class GridPositionCoder {
 public:
  explicit GridPositionCoder(Array<glm::ivec3>&& numbers) : numbers_(std::move(numbers)) {}

  void reserve(std::size_t vertices) { numbers_.reserve(vertices); }
  const glm::ivec3& at(Vertex v) const { return numbers_[v.index()]; }

  template <class Coder>
  bool code(Coder& coder, const PmHeader& header, const SplitRing& ring, RingPrefetch& next,
            NewSplit& split) {
    glm::ivec3 parent(0);
    glm::ivec3 child(0);
    if constexpr (!Coder::kDecodes) {
      parent = header.grid.numbers(split.parent_position, header.coordinate_bits);
      child = header.grid.numbers(split.child_position, header.coordinate_bits);
    }
    code_numbers(coder, ring, next, split, parent, child);
    const int highest = (1 << header.coordinate_bits) - 1;
    for (int i = 0; i < 3; ++i) {
      if (std::min(parent[i], child[i]) < 0 || std::max(parent[i], child[i]) > highest)
        return false;
    }
    numbers_[split.parent.index()] = parent;
    numbers_.push_back(child);
    split.parent_position = header.grid.position(parent);
    split.child_position = header.grid.position(child);
    return true;
  }

 private:
  template <class Coder>
  void code_numbers(Coder& coder, const SplitRing& ring, RingPrefetch& next, const NewSplit& split,
                    glm::ivec3& parent, glm::ivec3& child) {
    const auto ahead = [&] {
      next.step([&](Vertex v) { __builtin_prefetch(&numbers_[v.index()]); });
    };
    const SplitSides s(ring, split.cut);
    ahead();
    const glm::ivec3 before = numbers_[split.parent.index()];
    UnmovedEnd unmoved = parent == before  ? UnmovedEnd::parent
                         : child == before ? UnmovedEnd::child
                                           : UnmovedEnd::neither;
    unmoved = unmoved_.code(coder, unmoved);
    const glm::dvec3 apart = s.child - s.parent;
    PositionPrediction prediction{
        .mean = kApart * apart, .normal = normal_of(s), .variance = dot(apart, apart)};
    glm::ivec3 offset = child - parent;
    code_point(coder, difference_, glm::ivec3(0), prediction, ahead, offset);
    if (unmoved == UnmovedEnd::parent) {
      parent = before;
    } else if (unmoved == UnmovedEnd::child) {
      parent = before - offset;
    } else {
      const glm::dvec3 d(offset);
      prediction.mean = -0.4921875 * d + 0.1875 * (s.parent + s.child);
      prediction.variance = dot(d, d);
      prediction.stretch = d;
      use_plane(prediction, prediction.normal + cross(d, s.opening), -dot(d, s.child_normal));
      code_point(coder, parent_, before, prediction, ahead, parent);
    }
    child = parent + offset;
  }

  template <class Coder, class Ahead>
  static void code_point(Coder& coder, ResidualCoder& model, const glm::ivec3& at,
                         const PositionPrediction& prediction, const Ahead& ahead,
                         glm::ivec3& numbers) {
    // Far outside the grid; clamps values that only hostile files contain.
    constexpr std::int64_t most = std::int64_t{1} << 26U;
    const CoordinateOrder order(prediction);
    const Coordinates from = order.by_step(glm::dvec3(at));
    const std::array<int, 3> actual{numbers.x, numbers.y, numbers.z};
    std::array<int, 3> coded{};
    Coordinates point{};
    const auto code_step = [&]<std::size_t kStep>(std::integral_constant<std::size_t, kStep>) {
      ahead();
      const auto axis = static_cast<std::size_t>(order.axis(kStep));
      const std::int64_t before = nearest(from[kStep] + order.mean<kStep>(point), most);
      const int width = (exponent_of(order.variance(kStep)) - 1023) / 2;
      const std::int64_t number =
          before +
          model.template code<kStep>(coder, prediction.has_plane, width, 0, actual[axis] - before);
      coded[axis] = static_cast<int>(std::clamp(number, -most, most));
      point[kStep] = coded[axis] - from[kStep];
    };
    code_step(kFirst);
    code_step(kSecond);
    code_step(kThird);
    numbers = {coded[0], coded[1], coded[2]};
  }

  /// Returns the nearest integer, rounding halves up; 0 for NaN.
  static std::int64_t nearest(double value, std::int64_t most) {
    const double limit = static_cast<double>(most);
    if (!(value > -limit)) return value <= -limit ? -most : 0;
    if (value >= limit) return most;
    const double up = value + 0.5;
    const auto whole = static_cast<std::int64_t>(up);
    return whole - (static_cast<double>(whole) > up ? 1 : 0);
  }

  Array<glm::ivec3> numbers_;
  UnmovedEndCoder unmoved_;
  ResidualCoder difference_;
  ResidualCoder parent_;
};

}  // namespace

template <class Coder>
struct SplitCoder<Coder>::State {
  PmHeader header;
  SplitRing ring;
  ParentCoder parents;
  CutCoder cut;
  FloatPositionCoder floats;
  GridPositionCoder grid;
  SharpSplitCoder sharpness;
  SharpCornerCoder corners;
  Vertex next_parent;
  RingPrefetch prefetch;
  std::uint32_t block_begin = 0;
  std::uint32_t block_end = 0;
  std::uint64_t most_moved = 0;
  std::uint64_t most_walked = 0;
  std::uint64_t moved = 0;
  std::uint64_t walked = 0;

  State(const PmHeader& h, Array<glm::ivec3>&& numbers) : header(h), grid(std::move(numbers)) {}

  /// Codes the parent of split i. Pre: the models have adapted to all splits before it.
  void code_parent(Coder& coder, const ProgressiveMesh& pm, std::uint32_t i) {
    Vertex actual;
    if constexpr (!Coder::kDecodes) actual = pm.splits()[i].parent;
    next_parent = parents.code(coder, actual);
  }

  std::string_view gather(const Mesh& mesh, Vertex v) {
    if (!v.is_valid()) return "a split has a parent that is not there";
    const bool is_gathered =
        header.is_quantized()
            ? ring.gather(mesh, v, [&](Vertex u) { return glm::dvec3(grid.at(u)); })
            : ring.gather(mesh, v, [&](Vertex u) { return glm::dvec3(mesh.position(u)); });
    if (!is_gathered) return "a split has a parent of too many faces";
    walked += ring.faces();
    return walked <= most_walked ? std::string_view{}
                                 : "too many faces around the parents of splits";
  }

  std::string_view code_cut(Coder& coder, const ProgressiveMesh& pm, NewSplit& split) {
    split.cut = cut.code(coder, ring, split.cut);
    // The model yields slots of the ring only; these are the remaining conditions of can_append.
    constexpr std::uint32_t most_faces = kNone / 3 - 2;
    if (split.cut.left == split.cut.right || pm.full_face_count() > most_faces) {
      return "a split cuts where it cannot";
    }
    MESHER_ASSERT(!Coder::kDecodes || pm.can_append(split.parent, split.cut));
    moved += ring.moved(split.cut);
    parents.note(ring, split.parent, split.cut);
    return moved <= most_moved ? std::string_view{} : "splits move too many corners";
  }
};

template <class Coder>
SplitCoder<Coder>::SplitCoder(const PmHeader& header, Array<glm::ivec3>&& grid)
    : state_(std::make_unique<State>(header, std::move(grid))) {}

template <class Coder>
SplitCoder<Coder>::~SplitCoder() = default;

template <class Coder>
void SplitCoder<Coder>::reserve(std::uint32_t base_vertices, std::uint32_t splits) {
  if (state_->header.is_quantized()) state_->grid.reserve(std::size_t{base_vertices} + splits);
}

template <class Coder>
void SplitCoder<Coder>::begin_block(std::uint32_t begin, std::uint32_t end) {
  state_->block_begin = begin;
  state_->block_end = end;
  state_->most_moved = pm_most_moved(end);
  state_->most_walked = pm_most_walked(end);
}

template <class Coder>
ParentFan SplitCoder<Coder>::fan() const {
  return state_->ring.fan();
}

template <class Coder>
std::string_view SplitCoder<Coder>::code(Coder& coder, const ProgressiveMesh& pm, NewSplit& split) {
  State& s = *state_;
  const Mesh& mesh = pm.mesh();
  const std::uint32_t i = pm.level();
  if (i == 0) s.parents.begin(pm);
  if (i == s.block_begin) s.code_parent(coder, pm, i);
  split.parent = s.next_parent;
  if (const auto why = s.gather(mesh, split.parent); !why.empty()) return why;
  if (const auto why = s.code_cut(coder, pm, split); !why.empty()) return why;
  // The next parent is coded before the positions, so that prefetching around it can begin early.
  s.next_parent = Vertex{};
  if (i + 1 < s.block_end) s.code_parent(coder, pm, i + 1);
  s.prefetch.begin(mesh, pm.base_vertex_count() + i, s.next_parent);
  const bool is_placed = s.header.is_quantized()
                             ? s.grid.code(coder, s.header, s.ring, s.prefetch, split)
                             : s.floats.code(coder, mesh, s.ring, s.prefetch, split);
  if (!is_placed) return "a split has a position outside the range of coordinates";
  if (s.header.has_sharp_edges()) {
    const auto why = s.sharpness.code(coder, mesh, s.ring, split);
    if (!why.empty()) return why;
  }
  if (!s.header.has_sharp_vertices()) return {};
  return s.corners.code(coder, mesh, split);
}

template class SplitCoder<RangeEncoder>;
template class SplitCoder<RangeDecoder>;

}  // namespace mesher::progressive
