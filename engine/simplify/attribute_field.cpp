#include "engine/simplify/attribute_field.h"

#include <algorithm>

#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"

namespace mesher::simplify {
namespace {

constexpr std::size_t kFieldGrain = std::size_t{1} << 12;
// A face thinner than this share of its longest side counts as that thick: the gradient over a
// sliver is noise, and its rounding would stay in the sums.
constexpr float kThinnest = 0.01F;

Quadric<float> matrix(const float* sums) {
  return {sums[1], sums[2], sums[3], sums[4], sums[5], sums[6], {0.0F, 0.0F, 0.0F}};
}

/// Four components of gradients: three coordinates of four attributes.
Vec3<Float4> four_gradients(const float* sums, std::size_t size) {
  return {load4(sums), load4(sums + size), load4(sums + 2 * size)};
}

float sum_of(Float4 lanes) {
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}
Vec3<float> sum_of(const Vec3<Float4>& lanes) {
  return {sum_of(lanes.x), sum_of(lanes.y), sum_of(lanes.z)};
}
Vec3<Float4> in_lanes(const Vec3<float>& v) {
  return {broadcast<Float4>(v.x), broadcast<Float4>(v.y), broadcast<Float4>(v.z)};
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

}  // namespace

/// What one face adds to the sums of its corners' wedges.
struct AttributeField::Contribution {
  std::array<Float4, kHeader / 4 + 3 * kMost / 4> rows;
};

AttributeField::AttributeField(const Surface& surface, const AttributeMetric& metric)
    : size_((metric.size + 3) / 4 * 4), used_(metric.size), stride_(kHeader + 3 * size_) {
  find_wedges(surface, metric);
  find_sums(surface);
}

/// A wedge has the mean of the values of its corners.
void AttributeField::find_wedges(const Surface& surface, const AttributeMetric& metric) {
  const Mesh& mesh = surface.mesh();
  wedge_.assign(mesh.halfedge_count(), kNone);
  std::uint32_t count = 0;
  const auto begin_wedge = [&] {
    values_.insert(values_.end(), size_, 0.0F);
    return count++;
  };
  std::vector<Halfedge> run;
  const auto end_run = [&] {
    if (run.empty()) return;
    const std::uint32_t wedge = begin_wedge();
    const std::uint32_t source = metric.of_corner[run.front().index()];
    const bool is_one =
        std::ranges::all_of(run, [&](Halfedge h) { return metric.of_corner[h.index()] == source; });
    source_.push_back(is_one ? source : kNone);
    const float share = 1.0F / static_cast<float>(run.size());
    for (const Halfedge h : run) {
      wedge_[h.index()] = wedge;
      for (std::size_t j = 0; j < used_; ++j)
        values_[size_ * wedge + j] += share * metric.at(h.index())[j];
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
    end_run();
  }
}

void AttributeField::find_sums(const Surface& surface) {
  const Mesh& mesh = surface.mesh();
  sums_.assign(stride_ * source_.size(), 0.0F);
  parallel_for(mesh.vertex_count(), kFieldGrain, [&](IndexRange range) {
    Contribution contribution;
    for (std::size_t v = range.begin; v < range.end; ++v) {
      for (const Halfedge h : halfedges_around(mesh, Vertex(static_cast<std::uint32_t>(v)))) {
        const Corners corners = this->corners(surface, h);
        contribute(corners, contribution);
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
    corners.values[c] = values(corners.wedge[c]);
  }
  return corners;
}

void AttributeField::contribute(const Corners& corners, Contribution& to) const {
  const auto& [a, b, c] = corners.values;
  const GradientBasis basis = gradient_basis(corners.position);
  const Vec3<Float4> first = in_lanes(basis.of_first * basis.area);
  const Vec3<Float4> second = in_lanes(basis.of_second * basis.area);
  // A gradient is a combination of two vectors, so three sums give that of the outer products.
  Float4 both_first{}, mixed{}, both_second{};
  for (std::size_t j = 0; j < size_; j += 4) {
    const Float4 at_first = load4(b + j) - load4(a + j);
    const Float4 at_second = load4(c + j) - load4(a + j);
    both_first += at_first * at_first;
    mixed += at_first * at_second;
    both_second += at_second * at_second;
    const Vec3<Float4> gradients = first * at_first + second * at_second;
    Float4* rows = &to.rows[(kHeader + j) / 4];
    rows[0] = gradients.x;
    rows[size_ / 4] = gradients.y;
    rows[2 * (size_ / 4)] = gradients.z;
  }
  const float m = sum_of(mixed);
  const Vec3<float> with_first = basis.of_first * sum_of(both_first) + basis.of_second * m;
  const Vec3<float> with_second = basis.of_first * m + basis.of_second * sum_of(both_second);
  const Vec3<float> u = basis.of_first * basis.area;
  const Vec3<float> v = basis.of_second * basis.area;
  to.rows[0] =
      Float4{basis.area, with_first.x * u.x + with_second.x * v.x,
             with_first.x * u.y + with_second.x * v.y, with_first.x * u.z + with_second.x * v.z};
  to.rows[1] =
      Float4{with_first.y * u.y + with_second.y * v.y, with_first.y * u.z + with_second.y * v.z,
             with_first.z * u.z + with_second.z * v.z, 0.0F};
}

void AttributeField::add(std::uint32_t wedge, const Contribution& contribution) {
  float* to = sums(wedge);
  for (std::size_t k = 0; k < stride_; k += 4)
    store4(to + k, load4(to + k) + contribution.rows[k / 4]);
}

void AttributeField::replace(std::uint32_t wedge, const Contribution& before,
                             const Contribution& after) {
  float* to = sums(wedge);
  for (std::size_t k = 0; k < stride_; k += 4)
    store4(to + k, load4(to + k) + (after.rows[k / 4] - before.rows[k / 4]));
}

void AttributeField::subtract(std::uint32_t wedge, const Contribution& contribution) {
  float* to = sums(wedge);
  for (std::size_t k = 0; k < stride_; k += 4)
    store4(to + k, load4(to + k) - contribution.rows[k / 4]);
}

AttributeField::Pairs AttributeField::pairs(const Mesh& mesh, Halfedge h) const {
  const Halfedge t = mesh.twin(h);
  Pairs result{{Pair{wedge_[h.index()], wedge_[Mesh::next(h).index()]}, Pair{}}, 1};
  if (!t.is_valid()) return result;
  const Pair right{wedge_[Mesh::next(t).index()], wedge_[t.index()]};
  if (right != result.pair[0]) result.pair[result.count++] = right;
  return result;
}

void AttributeField::add(const Pair& pair, const Vec3<float>& half, AttributeQuadric& to) const {
  const float* s0 = sums(pair.origin);
  const float* s1 = sums(pair.target);
  const float* a0 = values(pair.origin);
  const float* a1 = values(pair.target);
  const Quadric<float> m0 = matrix(s0);
  const Quadric<float> m1 = matrix(s1);
  const Vec3<float> of_origin = m0.times(half);
  const Vec3<float> of_target = m1.times(half);
  const float area = s0[0] + s1[0];
  const float inverse = area > 0.0F ? 1.0F / area : 0.0F;
  const Vec3<Float4> half4 = in_lanes(half);
  const Float4 inverse4 = broadcast<Float4>(inverse);
  const Float4 target_area = broadcast<Float4>(s1[0]);
  Float4 constant{};
  Vec3<Float4> linear{};
  Vec3<Float4> xyz{};    // with x
  Vec3<Float4> yz_zz{};  // yy, yz, zz
  for (std::size_t j = 0; j < size_; j += 4) {
    const Vec3<Float4> g0 = four_gradients(s0 + kHeader + j, size_);
    const Vec3<Float4> g1 = four_gradients(s1 + kHeader + j, size_);
    const Vec3<Float4> g = g0 + g1;
    const Float4 d = load4(a1 + j) - load4(a0 + j);
    // The mean is (c + g.y) / area, relative to the value at the origin.
    const Float4 c = target_area * d + dot(g0 - g1, half4);
    const Float4 mean = c * inverse4;
    constant += d * (target_area * d - broadcast<Float4>(2.0F) * dot(g1, half4)) - c * mean;
    linear = linear - g1 * d + g * mean;
    const Vec3<Float4> w = g * inverse4;
    xyz = xyz + g * w.x;
    yz_zz = yz_zz + Vec3<Float4>{g.y * w.y, g.y * w.z, g.z * w.z};
  }
  const Vec3<float> with_x = sum_of(xyz);
  const Vec3<float> others = sum_of(yz_zz);
  to.a =
      to.a + (m0 + m1 -
              Quadric<float>{
                  with_x.x, with_x.y, with_x.z, others.x, others.y, others.z, {0.0F, 0.0F, 0.0F}});
  to.linear = to.linear + (of_target - of_origin) + sum_of(linear);
  to.constant += dot(half, of_origin + of_target) + sum_of(constant);
}

AttributeQuadric AttributeField::quadric(const Surface& surface, Halfedge h) const {
  const Mesh& mesh = surface.mesh();
  const Vec3<float> half =
      (surface.state(mesh.target(h)).position - surface.state(mesh.origin(h)).position) * 0.5F;
  AttributeQuadric result;
  for (const Pair& pair : pairs(mesh, h).all())
    add(pair, half, result);
  return result;
}

/// Cost of moving the vertex of one wedge by `y`, where it gets the values of another one.
float AttributeField::moving_cost(std::uint32_t moving, std::uint32_t fixed,
                                  const Vec3<float>& y) const {
  const float* s = sums(moving);
  const Vec3<Float4> y4 = in_lanes(y);
  Float4 sum{};
  for (std::size_t j = 0; j < size_; j += 4) {
    const Float4 d = load4(values(moving) + j) - load4(values(fixed) + j);
    const Float4 along = dot(four_gradients(s + kHeader + j, size_), y4);
    sum += d * (broadcast<Float4>(2.0F) * along + broadcast<Float4>(s[0]) * d);
  }
  return std::max(dot(y, matrix(s).times(y)) + sum_of(sum), 0.0F);
}

float AttributeField::cost_at_target(const Surface& surface, Halfedge h) const {
  const Mesh& mesh = surface.mesh();
  const Vec3<float> y =
      surface.state(mesh.target(h)).position - surface.state(mesh.origin(h)).position;
  float cost = 0.0F;
  for (const Pair& pair : pairs(mesh, h).all())
    cost += moving_cost(pair.origin, pair.target, y);
  return cost;
}

float AttributeField::cost_at_origin(const Surface& surface, Halfedge h) const {
  const Mesh& mesh = surface.mesh();
  const Vec3<float> y =
      surface.state(mesh.origin(h)).position - surface.state(mesh.target(h)).position;
  float cost = 0.0F;
  for (const Pair& pair : pairs(mesh, h).all())
    cost += moving_cost(pair.target, pair.origin, y);
  return cost;
}

void AttributeField::merged_values(const Pair& pair, const Vec3<float>& half, const Vec3<float>& y,
                                   Values& to) const {
  const float* s0 = sums(pair.origin);
  const float* s1 = sums(pair.target);
  const float area = s0[0] + s1[0];
  const Vec3<Float4> from_origin = in_lanes(y + half);
  const Vec3<Float4> from_target = in_lanes(y - half);
  for (std::size_t j = 0; j < size_; j += 4) {
    const Float4 a = load4(values(pair.origin) + j);
    const Float4 d = load4(values(pair.target) + j) - a;
    const Float4 sum = d * broadcast<Float4>(s1[0]) +
                       dot(four_gradients(s0 + kHeader + j, size_), from_origin) +
                       dot(four_gradients(s1 + kHeader + j, size_), from_target);
    const Float4 share =
        area > 0.0F ? sum * broadcast<Float4>(1.0F / area) : d * broadcast<Float4>(0.5F);
    store4(to.data() + j, a + share);
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
    result.source[i] = source_[end];
    for (std::size_t j = 0; j < size_; j += 4)
      store4(result.values[i].data() + j, load4(values(end) + j));
  }
  return result;
}

void AttributeField::collapsing(const Surface& surface, Halfedge h, const Fan& fan,
                                const glm::vec3& p) {
  const Mesh& mesh = surface.mesh();
  const Merged merged = this->merged(surface, h, p);
  Contribution before, after;
  for (const Halfedge side : {h, mesh.twin(h)}) {
    if (!side.is_valid()) continue;
    const Corners corners = this->corners(surface, Mesh::prev(side));
    contribute(corners, before);
    subtract(corners.wedge[0], before);
  }
  // The wedges around the merged vertex are summed anew; no corner has those of `joined` any more.
  const auto name_after = [&](Halfedge spoke) {
    const std::uint32_t wedge = wedge_[spoke.index()];
    for (std::size_t i = 0; i < merged.pairs.count; ++i) {
      if (wedge == merged.pairs.pair[i].origin) return merged.pairs.pair[i].target;
    }
    return wedge;
  };
  const auto values_after = [&](std::uint32_t wedge) {
    for (std::size_t i = 0; i < merged.pairs.count; ++i) {
      if (wedge == merged.pairs.pair[i].target) return merged.values[i].data();
    }
    return static_cast<const float*>(values(wedge));
  };
  for (const Halfedge spoke : fan.spokes())
    std::fill_n(sums(name_after(spoke)), stride_, 0.0F);
  for (const Halfedge spoke : fan.spokes()) {
    Corners corners = this->corners(surface, spoke);
    contribute(corners, before);
    corners.wedge[0] = name_after(spoke);
    corners.values[0] = values_after(corners.wedge[0]);
    corners.position[0] = {p.x, p.y, p.z};
    contribute(corners, after);
    add(corners.wedge[0], after);
    replace(corners.wedge[1], before, after);
    replace(corners.wedge[2], before, after);
  }
  for (const Halfedge spoke : fan.spokes())
    wedge_[spoke.index()] = name_after(spoke);
  for (std::size_t i = 0; i < merged.pairs.count; ++i) {
    const std::uint32_t wedge = merged.pairs.pair[i].target;
    for (std::size_t j = 0; j < size_; j += 4)
      store4(values(wedge) + j, load4(merged.values[i].data() + j));
    source_[wedge] = merged.source[i];
  }
}

}  // namespace mesher::simplify
