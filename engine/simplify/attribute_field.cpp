#include "engine/simplify/attribute_field.h"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"

namespace mesher::simplify {
namespace {

constexpr std::size_t kFieldGrain = std::size_t{1} << 12;
// A face thinner than this share of its longest side counts as that thick: the gradient over a
// sliver is noise, and its rounding would stay in the sums.
constexpr float kThinnest = 0.01F;

Quadric<float> matrix(const float* record) {
  return {record[1], record[2], record[3], record[4], record[5], record[6], {0.0F, 0.0F, 0.0F}};
}

float sum_of(Float4 lanes) {
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

/// The directions by which differences of a value become its gradient over a face.
struct GradientBasis {
  Vec3<float> of_first;   ///< times value 1 - value 0
  Vec3<float> of_second;  ///< times value 2 - value 0
  float area;
};

GradientBasis gradient_basis(const std::array<Vec3<float>, 3>& p) {
  const Vec3<float> first = p[1] - p[0];
  const Vec3<float> second = p[2] - p[0];
  const Vec3<float> third = p[2] - p[1];
  const Vec3<float> normal = cross(first, second);
  const float area2 = dot(normal, normal);
  const float longest2 = std::max({dot(first, first), dot(second, second), dot(third, third)});
  const float least = kThinnest * longest2;
  const float divisor = std::max(area2, least * least);
  const float inverse = divisor > 0.0F ? 1.0F / divisor : 0.0F;
  return {cross(second, normal) * inverse, cross(normal, first) * inverse, 0.5F * std::sqrt(area2)};
}

/// Four rows as columns: the same component of four records.
struct Columns {
  Float4 a, b, c, d;
  explicit Columns(const std::array<const float*, 4>& rows, std::size_t offset)
      : a(load4(rows[0] + offset)),
        b(load4(rows[1] + offset)),
        c(load4(rows[2] + offset)),
        d(load4(rows[3] + offset)) {
    transpose(a, b, c, d);
  }
  Vec3<Float4> xyz() const { return {a, b, c}; }
};

/// Four sums of areas and of matrices.
struct Headers {
  Float4 area;
  Quadric<Float4> matrix;
  explicit Headers(const std::array<const float*, 4>& records) {
    const Columns first(records, 0);
    const Columns second(records, 4);
    area = first.a;
    matrix = Quadric<Float4>{first.b, first.c, first.d, second.a, second.b, second.c, {}};
  }
};

}  // namespace

/// What one face adds to the record of its corners' wedges.
struct AttributeField::Contribution {
  std::array<Float4, 2 + kMost> rows;
};

AttributeField::AttributeField(const Surface& surface, const AttributeMetric& metric)
    : size_(metric.size), stride_(row(metric.size)) {
  for (const AttributeMetric::Layer& layer : metric.layers) {
    if (layer.is_texcoord) texcoords_.push_back(layer.first);
  }
  find_wedges(surface, metric);
  find_sums(surface);
}

/// A wedge has the mean of the values of its corners.
void AttributeField::find_wedges(const Surface& surface, const AttributeMetric& metric) {
  const Mesh& mesh = surface.mesh();
  wedge_.assign(mesh.halfedge_count(), kNone);
  records_.reserve(stride_ * mesh.vertex_count());
  source_.reserve(mesh.vertex_count());
  std::vector<Halfedge> run;
  bool has_own = false;
  const auto make_wedge = [&] {
    const auto wedge = static_cast<std::uint32_t>(source_.size());
    const std::uint32_t source = metric.of_corner[run.front().index()];
    const bool is_one =
        std::ranges::all_of(run, [&](Halfedge h) { return metric.of_corner[h.index()] == source; });
    source_.push_back(is_one ? source : kOwn);
    has_own |= !is_one;
    records_.insert(records_.end(), stride_, 0.0F);
    const float share = is_one ? 1.0F : 1.0F / static_cast<float>(run.size());
    for (const Halfedge h : run)
      wedge_[h.index()] = wedge;
    for (const Halfedge h : std::span(run).first(is_one ? 1 : run.size())) {
      for (std::size_t j = 0; j < size_; ++j)
        record(wedge)[row(j) + 3] += share * metric.at(h.index())[j];
    }
    run.clear();
  };
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    if (wedge_[i] != kNone) continue;
    // From the first corner past a feature edge, counterclockwise to the next one.
    Halfedge first(i);
    for (Circulator<Mesh, Turn::cw> at(mesh, Halfedge(i)); !surface.is_feature(*at);) {
      if (!at.advance()) break;
      first = *at;
    }
    Circulator at(mesh, first);
    do {
      run.push_back(*at);
    } while (!surface.is_feature(Mesh::prev(*at)) && at.advance());
    make_wedge();
  }
  if (has_own) own_ = metric.of_corner;
}

void AttributeField::find_sums(const Surface& surface) {
  const Mesh& mesh = surface.mesh();
  // Other threads read the values, so only the sums are written.
  const auto add = [&](std::uint32_t wedge, const Contribution& contribution) {
    float* to = record(wedge);
    for (std::size_t k = 0; k < stride_; ++k) {
      if (k < row(0) || k % 4 != 3) to[k] += contribution.rows[k / 4][k % 4];
    }
  };
  parallel_for(mesh.vertex_count(), kFieldGrain, [&](IndexRange range) {
    Contribution contribution;
    for (std::size_t v = range.begin; v < range.end; ++v) {
      for (const Halfedge h : halfedges_around(mesh, Vertex(static_cast<std::uint32_t>(v)))) {
        const Corners corners = this->corners(surface, h);
        contribute(corners, nullptr, contribution);
        add(corners.wedge[0], contribution);
      }
    }
  });
}

AttributeField::Corners AttributeField::corners(const Surface& surface, Halfedge h) const {
  Corners corners;
  const std::array<Halfedge, 3> around{h, Mesh::next(h), Mesh::prev(h)};
  for (std::size_t c = 0; c < 3; ++c) {
    corners.position[c] = surface.state(surface.mesh().origin(around[c])).position;
    corners.wedge[c] = wedge_[around[c].index()];
  }
  return corners;
}

/// `first`: the values at the first corner if they are not those of its wedge.
void AttributeField::contribute(const Corners& corners, const Values* first,
                                Contribution& to) const {
  const GradientBasis basis = gradient_basis(corners.position);
  const Vec3<float> u = basis.of_first * basis.area;
  const Vec3<float> v = basis.of_second * basis.area;
  const Float4 along_first{u.x, u.y, u.z, 0.0F};
  const Float4 along_second{v.x, v.y, v.z, 0.0F};
  // A gradient is a combination of two vectors, so three sums give that of the outer products.
  float both_first = 0.0F;
  float mixed = 0.0F;
  float both_second = 0.0F;
  for (std::size_t j = 0; j < size_; ++j) {
    const float a = first != nullptr ? (*first)[j] : value(corners.wedge[0], j);
    const float b = value(corners.wedge[1], j) - a;
    const float c = value(corners.wedge[2], j) - a;
    both_first += b * b;
    mixed += b * c;
    both_second += c * c;
    to.rows[2 + j] = along_first * broadcast<Float4>(b) + along_second * broadcast<Float4>(c);
  }
  const Vec3<float> s = basis.of_first * both_first + basis.of_second * mixed;
  const Vec3<float> t = basis.of_first * mixed + basis.of_second * both_second;
  to.rows[0] =
      Float4{basis.area, s.x * u.x + t.x * v.x, s.x * u.y + t.x * v.y, s.x * u.z + t.x * v.z};
  to.rows[1] = Float4{s.y * u.y + t.y * v.y, s.y * u.z + t.y * v.z, s.z * u.z + t.z * v.z, 0.0F};
}

void AttributeField::change(std::uint32_t wedge, const Contribution& by, float sign) {
  float* to = record(wedge);
  const Float4 signs = broadcast<Float4>(sign);
  for (std::size_t k = 0; k < stride_; k += 4)
    store4(to + k, load4(to + k) + signs * by.rows[k / 4]);
}

/// Clears the sums; the values stay.
void AttributeField::clear(std::uint32_t wedge) {
  float* to = record(wedge);
  for (std::size_t k = 0; k < stride_; k += 4)
    store4(to + k, Float4{0.0F, 0.0F, 0.0F, k < row(0) ? 0.0F : to[k + 3]});
}

AttributeField::Pairs AttributeField::pairs(const Mesh& mesh, Halfedge h) const {
  const Halfedge t = mesh.twin(h);
  Pairs result{{Pair{wedge_[h.index()], wedge_[Mesh::next(h).index()]}, Pair{}}, 1};
  if (!t.is_valid()) return result;
  const Pair right{wedge_[Mesh::next(t).index()], wedge_[t.index()]};
  if (right != result.pair[0]) result.pair[result.count++] = right;
  return result;
}

AttributeQuadric<Float4> AttributeField::quadrics(const std::array<Pair, 4>& pairs,
                                                  const Vec3<Float4>& half) const {
  std::array<const float*, 4> from, to;
  for (std::size_t lane = 0; lane < 4; ++lane) {
    from[lane] = record(pairs[lane].origin);
    to[lane] = record(pairs[lane].target);
  }
  const Headers of_origin(from);
  const Headers of_target(to);
  const Vec3<Float4> at_origin = of_origin.matrix.times(half);
  const Vec3<Float4> at_target = of_target.matrix.times(half);
  const Float4 zero = broadcast<Float4>(0.0F);
  const Float4 two = broadcast<Float4>(2.0F);
  const Float4 area = of_origin.area + of_target.area;
  const Float4 inverse = select(area > zero, broadcast<Float4>(1.0F) / area, zero);
  AttributeQuadric<Float4> result{of_origin.matrix + of_target.matrix, at_target - at_origin,
                                  dot(half, at_origin + at_target)};
  for (std::size_t j = 0; j < size_; ++j) {
    const Columns first(from, row(j));
    const Columns second(to, row(j));
    const Vec3<Float4> g = first.xyz() + second.xyz();
    const Float4 d = second.d - first.d;
    const Float4 weighted = of_target.area * d;
    // The mean is (c + g.y) / area, relative to the value at the origin.
    const Float4 c = weighted + dot(first.xyz() - second.xyz(), half);
    const Float4 mean = c * inverse;
    result.constant += d * (weighted - two * dot(second.xyz(), half)) - c * mean;
    result.linear = result.linear - second.xyz() * d + g * mean;
    const Vec3<Float4> w = g * inverse;
    result.a.xx -= g.x * w.x;
    result.a.xy -= g.x * w.y;
    result.a.xz -= g.x * w.z;
    result.a.yy -= g.y * w.y;
    result.a.yz -= g.y * w.z;
    result.a.zz -= g.z * w.z;
  }
  return result;
}

AttributeQuadric<Float8> AttributeField::quadrics(const std::array<Halfedge, 8>& edges,
                                                  const Vec3<Float8>& half) const {
  std::array<std::array<Pair, 4>, 2> pairs;
  for (std::size_t lane = 0; lane < 8; ++lane) {
    const Halfedge h = edges[lane];
    pairs[lane / 4][lane % 4] = {wedge_[h.index()], wedge_[Mesh::next(h).index()]};
  }
  const auto p = quadrics(pairs[0], {half.x.low, half.y.low, half.z.low});
  const auto q = quadrics(pairs[1], {half.x.high, half.y.high, half.z.high});
  return {{{p.a.xx, q.a.xx},
           {p.a.xy, q.a.xy},
           {p.a.xz, q.a.xz},
           {p.a.yy, q.a.yy},
           {p.a.yz, q.a.yz},
           {p.a.zz, q.a.zz},
           {}},
          pair(p.linear, q.linear),
          {p.constant, q.constant}};
}

AttributeQuadric<float> AttributeField::quadric(const Surface& surface, Halfedge h) const {
  const Mesh& mesh = surface.mesh();
  const Vec3<float> half =
      (surface.state(mesh.target(h)).position - surface.state(mesh.origin(h)).position) * 0.5F;
  const Pairs sides = pairs(mesh, h);
  std::array<Pair, 4> lanes;
  lanes.fill(sides.pair[0]);
  lanes[1] = sides.pair[sides.count - 1];
  const AttributeQuadric<Float4> q = quadrics(
      lanes, {broadcast<Float4>(half.x), broadcast<Float4>(half.y), broadcast<Float4>(half.z)});
  const auto sum = [&](Float4 four) { return sides.count == 1 ? four[0] : four[0] + four[1]; };
  return {{sum(q.a.xx), sum(q.a.xy), sum(q.a.xz), sum(q.a.yy), sum(q.a.yz), sum(q.a.zz), {}},
          {sum(q.linear.x), sum(q.linear.y), sum(q.linear.z)},
          sum(q.constant)};
}

/// Cost of moving the vertex of one wedge by `y`, where it gets the values of another one.
float AttributeField::moving_cost(std::uint32_t moving, std::uint32_t fixed,
                                  const Vec3<float>& y) const {
  const float* s = record(moving);
  const Float4 along{y.x, y.y, y.z, 0.0F};
  float cost = dot(y, matrix(s).times(y));
  for (std::size_t j = 0; j < size_; ++j) {
    const float d = value(moving, j) - value(fixed, j);
    cost += d * (2.0F * sum_of(load4(s + row(j)) * along) + s[0] * d);
  }
  return std::max(cost, 0.0F);
}

float AttributeField::cost_at_end(const Surface& surface, Halfedge h, bool is_at_target) const {
  const Mesh& mesh = surface.mesh();
  const Vec3<float> edge =
      surface.state(mesh.target(h)).position - surface.state(mesh.origin(h)).position;
  const Pairs sides = pairs(mesh, h);
  float cost = 0.0F;
  for (const Pair& pair : sides.all()) {
    cost += is_at_target ? moving_cost(pair.origin, pair.target, edge)
                         : moving_cost(pair.target, pair.origin, edge * -1.0F);
  }
  return cost;
}

void AttributeField::merged_values(const Pair& pair, const Vec3<float>& half, const Vec3<float>& y,
                                   Values& to) const {
  const float* s0 = record(pair.origin);
  const float* s1 = record(pair.target);
  const float area = s0[0] + s1[0];
  const Vec3<float> from_origin = y + half;
  const Vec3<float> from_target = y - half;
  const Float4 along_origin{from_origin.x, from_origin.y, from_origin.z, 0.0F};
  const Float4 along_target{from_target.x, from_target.y, from_target.z, 0.0F};
  for (std::size_t j = 0; j < size_; ++j) {
    const float a = value(pair.origin, j);
    const float d = value(pair.target, j) - a;
    const float sum =
        s1[0] * d + sum_of(load4(s0 + row(j)) * along_origin + load4(s1 + row(j)) * along_target);
    to[j] = area > 0.0F ? a + sum / area : a + 0.5F * d;
  }
}

AttributeField::Merged AttributeField::merged(const Surface& surface, Halfedge h,
                                              const glm::vec3& p) const {
  const Mesh& mesh = surface.mesh();
  const Vec3<float> from = surface.state(mesh.origin(h)).position;
  const Vec3<float> half = (surface.state(mesh.target(h)).position - from) * 0.5F;
  const bool is_at_target = p == mesh.position(mesh.target(h));
  const bool is_at_end = is_at_target || p == mesh.position(mesh.origin(h));
  Merged result{.pairs = pairs(mesh, h)};
  for (std::size_t i = 0; i < result.pairs.count; ++i) {
    const Pair& pair = result.pairs.pair[i];
    if (!is_at_end) {
      merged_values(pair, half, Vec3<float>{p.x, p.y, p.z} - (from + half), result.values[i]);
      continue;
    }
    const std::uint32_t end = is_at_target ? pair.target : pair.origin;
    // Corners of other wedges join, so the mean is all that they have in common.
    result.source[i] = source_[end] == kOwn ? kNone : source_[end];
    for (std::size_t j = 0; j < size_; ++j)
      result.values[i][j] = value(end, j);
  }
  if (result.pairs.count == 2 && !is_at_end) keep_equal(result);
  return result;
}

/// Numbers that agree across a line at both of its ends still do afterward: a seam of the texture
/// does not split normals.
void AttributeField::keep_equal(Merged& merged) const {
  const auto& [left, right] = merged.pairs.pair;
  const auto area = [&](const Pair& pair) {
    return record(pair.origin)[0] + record(pair.target)[0];
  };
  const float sum = area(left) + area(right);
  const float part = sum > 0.0F ? area(left) / sum : 0.5F;
  for (std::size_t j = 0; j < size_; ++j) {
    if (value(left.origin, j) != value(right.origin, j) ||
        value(left.target, j) != value(right.target, j)) {
      continue;
    }
    const float mean = merged.values[1][j] + part * (merged.values[0][j] - merged.values[1][j]);
    merged.values[0][j] = merged.values[1][j] = mean;
  }
}

bool AttributeField::flips_texture(const Surface& surface, Halfedge h, const Fan& fan,
                                   const glm::vec3& p) const {
  if (texcoords_.empty()) return false;
  const Merged merged = this->merged(surface, h, p);
  for (const Halfedge spoke : fan.spokes()) {
    const std::uint32_t a = wedge_[spoke.index()];
    const std::uint32_t b = wedge_[Mesh::next(spoke).index()];
    const std::uint32_t c = wedge_[Mesh::prev(spoke).index()];
    const std::uint32_t name = merged.name_after(a);
    const Values* const values = merged.values_after(name);
    if (values == nullptr) continue;  // none of its corners changes
    for (const std::size_t j : texcoords_) {
      const auto area = [&](float u, float v) {
        return (value(b, j) - u) * (value(c, j + 1) - v) -
               (value(b, j + 1) - v) * (value(c, j) - u);
      };
      const float before = area(value(a, j), value(a, j + 1));
      const float after = area((*values)[j], (*values)[j + 1]);
      if (before != 0.0F && (after == 0.0F || (before > 0.0F) != (after > 0.0F))) return true;
    }
  }
  return false;
}

void AttributeField::collapsing(const Surface& surface, Halfedge h, const Fan& fan,
                                const glm::vec3& p) {
  const Mesh& mesh = surface.mesh();
  const Merged merged = this->merged(surface, h, p);
  Contribution before, after;
  for (const Halfedge side : {h, mesh.twin(h)}) {
    if (!side.is_valid()) continue;
    const Corners corners = this->corners(surface, Mesh::prev(side));
    contribute(corners, nullptr, before);
    change(corners.wedge[0], before, -1.0F);
  }
  // The wedges of the merged vertex are summed anew.
  std::uint32_t cleared = kNone;
  for (const Halfedge spoke : fan.spokes()) {
    const std::uint32_t wedge = merged.name_after(wedge_[spoke.index()]);
    if (wedge != cleared) clear(wedge);
    cleared = wedge;
  }
  for (const Halfedge spoke : fan.spokes()) {
    Corners corners = this->corners(surface, spoke);
    contribute(corners, nullptr, before);
    corners.wedge[0] = merged.name_after(corners.wedge[0]);
    corners.position[0] = {p.x, p.y, p.z};
    contribute(corners, merged.values_after(corners.wedge[0]), after);
    change(corners.wedge[0], after, 1.0F);
    for (std::size_t k = 0; k < stride_ / 4; ++k)
      after.rows[k] = after.rows[k] - before.rows[k];
    change(corners.wedge[1], after, 1.0F);
    change(corners.wedge[2], after, 1.0F);
  }
  for (const Halfedge spoke : fan.spokes())
    wedge_[spoke.index()] = merged.name_after(wedge_[spoke.index()]);
  for (std::size_t i = 0; i < merged.pairs.count; ++i) {
    const std::uint32_t wedge = merged.pairs.pair[i].target;
    for (std::size_t j = 0; j < size_; ++j)
      record(wedge)[row(j) + 3] = merged.values[i][j];
    source_[wedge] = merged.source[i];
  }
}

void AttributeField::append_values(Halfedge h, float scale, Array<float>& to) const {
  for (std::size_t j = 0; j < size_; ++j)
    to.push_back(scale * value(wedge_[h.index()], j));
}

}  // namespace mesher::simplify
