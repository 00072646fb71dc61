#include "engine/simplify/attribute_field.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/core/parallel.h"
#include "engine/mesh/circulators.h"

namespace mesher::simplify {
namespace {

constexpr std::size_t kFieldGrain = std::size_t{1} << 12;

Quadric<float> matrix(const float* record) {
  return {record[1], record[2], record[3], record[4], record[5], record[6], {0.0F, 0.0F, 0.0F}};
}

/// The records of four wedges, which are read as columns: the same component of each.
class FourRecords {
 public:
  explicit FourRecords(const std::array<const float*, 4>& records)
      : records_(records),
        is_one_(records[0] == records[1] && records[0] == records[2] && records[0] == records[3]) {}

  /// Returns the columns of a row that begins at `offset`.
  std::array<Float4, 4> columns(std::size_t offset) const {
    const Float4 first = load4(records_[0] + offset);
    if (is_one_) {
      return {__builtin_shufflevector(first, first, 0, 0, 0, 0),
              __builtin_shufflevector(first, first, 1, 1, 1, 1),
              __builtin_shufflevector(first, first, 2, 2, 2, 2),
              __builtin_shufflevector(first, first, 3, 3, 3, 3)};
    }
    std::array<Float4, 4> all{first, load4(records_[1] + offset), load4(records_[2] + offset),
                              load4(records_[3] + offset)};
    transpose(all[0], all[1], all[2], all[3]);
    return all;
  }

 private:
  std::array<const float*, 4> records_;
  bool is_one_;
};

/// Four sums of areas and of matrices.
struct Headers {
  Float4 area;
  Quadric<Float4> matrix;
  explicit Headers(const FourRecords& records) {
    const std::array<Float4, 4> first = records.columns(0);
    const std::array<Float4, 4> second = records.columns(4);
    area = first[0];
    matrix = Quadric<Float4>{first[1], first[2], first[3], second[0], second[1], second[2], {}};
  }
};

}  // namespace

AttributeField::AttributeField(const Surface& surface, const AttributeMetric& metric)
    : size_(metric.size), stride_(row(metric.size)) {
  for (const AttributeMetric::Layer& layer : metric.layers) {
    if (!layer.is_texcoord) continue;
    texcoords_.push_back(layer.first);
    is_texcoord_.at(layer.first) = is_texcoord_.at(layer.first + 1) = true;
  }
  find_wedges(surface, metric);
  find_sums(surface);
}

/// A wedge has the mean of the values of its corners.
void AttributeField::find_wedges(const Surface& surface, const AttributeMetric& metric) {
  const Mesh& mesh = surface.mesh();
  wedge_.assign(mesh.halfedge_count(), kNone);
  // Each wedge is all of a vertex, or begins at a feature edge.
  std::size_t most = mesh.vertex_count();
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i)
    most += surface.is_feature(Halfedge(i)) ? 1 : 0;
  records_.reserve(stride_ * most);
  source_.reserve(most);
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
  const auto add = [&](const FourFaces& faces, std::size_t count) {
    FourContributions contributions;
    contributions.set(faces, size_);
    for (std::size_t face = 0; face < count; ++face) {
      float* const to = record(faces.wedge_at(0, face));
      for (std::size_t k = 0; k < stride_; k += 4) {
        const Float4 sum = load4(to + k) + contributions.row(k / 4, face);
        std::memcpy(to + k, &sum, (k < row(0) ? 4 : 3) * sizeof(float));
      }
    }
  };
  parallel_for(mesh.vertex_count(), kFieldGrain, [&](IndexRange range) {
    FourFaces faces;
    FourHalfedges corners;
    std::size_t count = 0;
    const auto flush = [&] {
      load(surface, corners, faces);
      add(faces, count);
      count = 0;
    };
    for (std::size_t v = range.begin; v < range.end; ++v) {
      for (const Halfedge h : halfedges_around(mesh, Vertex(static_cast<std::uint32_t>(v)))) {
        if (count == 0) corners.fill(h);
        corners[count] = h;
        if (++count == 4) flush();
      }
    }
    if (count > 0) flush();
  });
}

FourWedges AttributeField::wedges(const FourHalfedges& from) const {
  const auto of = [&](auto corner) {
    const auto wedge = [&](std::size_t face) {
      return static_cast<std::int32_t>(wedge_[corner(from[face]).index()]);
    };
    return Int4{wedge(0), wedge(1), wedge(2), wedge(3)};
  };
  return {of([](Halfedge h) { return h; }), of(Mesh::next), of(Mesh::prev)};
}

Float4 AttributeField::values(Int4 wedges, std::size_t j) const {
  const auto of = [&](std::size_t lane) {
    return value(static_cast<std::uint32_t>(wedges[lane]), j);
  };
  return Float4{of(0), of(1), of(2), of(3)};
}

void AttributeField::load(const Surface& surface, const FourHalfedges& from, FourFaces& to) const {
  // The position follows the last number of the quadric.
  const auto positions = [&](auto corner) {
    std::array<Float4, 4> rows;
    for (std::size_t face = 0; face < 4; ++face)
      rows[face] = load4(&surface.state(surface.mesh().origin(corner(from[face]))).quadric.g.z);
    transpose(rows[0], rows[1], rows[2], rows[3]);
    return Vec3<Float4>{rows[1], rows[2], rows[3]};
  };
  to.position = {positions([](Halfedge h) { return h; }), positions(Mesh::next),
                 positions(Mesh::prev)};
  to.wedge = wedges(from);
  for (std::size_t corner = 0; corner < 3; ++corner) {
    for (std::size_t j = 0; j < size_; ++j)
      to.values[corner][j] = values(to.wedge[corner], j);
  }
}

AttributeField::Pairs AttributeField::pairs(const Mesh& mesh, Halfedge h) const {
  const Halfedge t = mesh.twin(h);
  Pairs result{{Pair{wedge_[h.index()], wedge_[Mesh::next(h).index()]}, Pair{}}, 1};
  if (!t.is_valid()) return result;
  const Pair right{wedge_[Mesh::next(t).index()], wedge_[t.index()]};
  if (right != result.pair[0]) result.pair[result.count++] = right;
  return result;
}

template <AttributeField::Part kPart>
AttributeQuadric<Float4> AttributeField::quadrics(const std::array<Pair, 4>& pairs,
                                                  const Vec3<Float4>& half) const {
  const auto records = [&](std::uint32_t Pair::*end) {
    return FourRecords({record(pairs[0].*end), record(pairs[1].*end), record(pairs[2].*end),
                        record(pairs[3].*end)});
  };
  const FourRecords from = records(&Pair::origin);
  const FourRecords to = records(&Pair::target);
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
    const auto [x0, y0, z0, value0] = from.columns(row(j));
    const auto [x1, y1, z1, value1] = to.columns(row(j));
    const Vec3<Float4> first{x0, y0, z0};
    const Vec3<Float4> second{x1, y1, z1};
    const Float4 d = value1 - value0;
    const Float4 weighted = of_target.area * d;
    // The mean is (c + g.y) / area, relative to the value at the origin.
    const Float4 c = weighted + dot(first - second, half);
    const Float4 mean = c * inverse;
    result.constant += d * (weighted - two * dot(second, half)) - c * mean;
    if constexpr (kPart == Part::constant) continue;
    const Vec3<Float4> g = first + second;
    result.linear = result.linear - second * d + g * mean;
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

std::array<std::array<AttributeField::Pair, 4>, 2> AttributeField::pairs(
    const std::array<Halfedge, 8>& edges) const {
  std::array<std::array<Pair, 4>, 2> pairs;
  for (std::size_t lane = 0; lane < 8; ++lane) {
    const Halfedge h = edges[lane];
    pairs[lane / 4][lane % 4] = {wedge_[h.index()], wedge_[Mesh::next(h).index()]};
  }
  return pairs;
}

AttributeQuadric<Float8> AttributeField::quadrics(const std::array<Halfedge, 8>& edges,
                                                  const Vec3<Float8>& half) const {
  const auto [low, high] = pairs(edges);
  const auto p = quadrics<Part::all>(low, {half.x.low, half.y.low, half.z.low});
  const auto q = quadrics<Part::all>(high, {half.x.high, half.y.high, half.z.high});
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

Float8 AttributeField::midpoint_costs(const std::array<Halfedge, 8>& edges,
                                      const Vec3<Float8>& half) const {
  const auto [low, high] = pairs(edges);
  const auto cost = [&](const std::array<Pair, 4>& four, const Vec3<Float4>& to_target) {
    return greater_of(quadrics<Part::constant>(four, to_target).constant, broadcast<Float4>(0.0F));
  };
  return {cost(low, {half.x.low, half.y.low, half.z.low}),
          cost(high, {half.x.high, half.y.high, half.z.high})};
}

AttributeQuadric<float> AttributeField::quadric(const Surface& surface, Halfedge h) const {
  const Mesh& mesh = surface.mesh();
  const Vec3<float> half =
      (surface.state(mesh.target(h)).position - surface.state(mesh.origin(h)).position) * 0.5F;
  const Pairs sides = pairs(mesh, h);
  std::array<Pair, 4> lanes;
  lanes.fill(sides.pair[0]);
  lanes[1] = sides.pair[sides.count - 1];
  const AttributeQuadric<Float4> q = quadrics<Part::all>(
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

void AttributeField::will_need(const Mesh& mesh, Halfedge h) const {
  for (const Halfedge corner : {h, Mesh::next(h), Mesh::prev(h)}) {
    will_need(wedge_[corner.index()]);
    if (const Halfedge t = mesh.twin(corner); t.is_valid()) prefetch(&wedge_[t.index()]);
  }
}

void AttributeField::append_values(Halfedge h, float scale, Array<float>& to) const {
  for (std::size_t j = 0; j < size_; ++j)
    to.push_back(scale * value(wedge_[h.index()], j));
}

}  // namespace mesher::simplify
