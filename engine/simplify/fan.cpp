#include "engine/simplify/fan.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "engine/mesh/circulators.h"

namespace mesher::simplify {
namespace {

// Two faces count as folded together if their normals differ by more than 150 degrees.
constexpr float kFoldedCosine = -0.8660254F;
// A face counts as turned if it turns by more than about 78 degrees in one collapse. A collapse
// that turns a face by more than 120 degrees is refused.
constexpr float kTurnedCosine = 0.2F;
constexpr float kLeastCosine = -0.5F;
// A face also counts as turned if it ends at more than a right angle to its normal in the input, so
// that turning it in many steps is not free. The margin covers the rounding of packed normals.
constexpr float kTurnedCosineOfAll = -0.002F;
// Weight of folded area: folds are visible from all sides.
constexpr float kFoldWeight = 4.0F;
// A face is degenerate in floats if its height vanishes against its longest side.
constexpr float kLeastAspect = 1e-5F;
// Padding past the last face, for whole lanes.
constexpr std::size_t kLanes = 16;

/// The normal and the compact area of a face.
struct Side {
  glm::vec3 normal;
  float area;
};

Side side_of(const Surface& surface, Face f) {
  const Mesh& mesh = surface.mesh();
  const auto squared_side = [&](std::uint32_t corner) {
    const Halfedge h = Mesh::halfedge(f, corner);
    const glm::vec3 side = mesh.position(mesh.target(h)) - mesh.position(mesh.origin(h));
    return glm::dot(side, side);
  };
  const float longest = std::max({squared_side(0), squared_side(1), squared_side(2)});
  const FaceShape& shape = surface.shape(f);
  return {shape.normal, compact_area(shape.area, longest)};
}

/// Returns the area over which two adjacent faces are folded together: that of the smaller one, or
/// 0.
float folded_area(const Side& a, const Side& b) {
  return glm::dot(a.normal, b.normal) < kFoldedCosine ? std::min(a.area, b.area) : 0.0F;
}

/// The connectivity at the merged vertex, as if the edge's faces were removed: the faces beyond
/// them become adjacent.
class MergedView {
 public:
  MergedView(const Mesh& mesh, Halfedge h) : mesh_(mesh), h_(h), t_(mesh.twin(h)) {}

  Halfedge rotate_ccw(Halfedge spoke) const {
    const Halfedge onward = mesh_.rotate_ccw(spoke);
    if (onward == Mesh::next(h_)) return mesh_.rotate_ccw(h_);
    if (t_.is_valid() && onward == Mesh::next(t_)) return mesh_.rotate_ccw(t_);
    return onward;
  }
  Halfedge rotate_cw(Halfedge spoke) const {
    const Halfedge onward = mesh_.rotate_cw(spoke);
    if (!onward.is_valid()) return onward;
    if (onward == h_) return mesh_.rotate_cw(Mesh::next(h_));
    if (onward == t_) return mesh_.rotate_cw(Mesh::next(t_));
    return onward;
  }
  /// Returns any spoke of the fan, or none if it has no faces.
  Halfedge any() const {
    if (const Halfedge s = mesh_.rotate_ccw(h_); s.is_valid()) return s;
    if (const Halfedge s = mesh_.rotate_cw(Mesh::next(h_)); s.is_valid()) return s;
    if (!t_.is_valid()) return {};
    if (const Halfedge s = mesh_.rotate_ccw(t_); s.is_valid()) return s;
    return mesh_.rotate_cw(Mesh::next(t_));
  }

 private:
  const Mesh& mesh_;
  Halfedge h_;
  Halfedge t_;
};

}  // namespace

Fan::Fan() {
  reserve(64);
}

/// Allocates memory for this many faces plus padding.
void Fan::reserve(std::size_t faces) {
  spokes_.resize(faces + kLanes);
  ring_.resize(faces + kLanes);
  for (std::vector<float>* numbers :
       {&x_, &y_, &z_, &area_, &compact_area_, &neighbor_x_, &neighbor_y_, &neighbor_z_})
    numbers->resize(faces + kLanes, 0.0F);
}

bool Fan::gather(const Surface& surface, Halfedge h, std::size_t limit) {
  const Mesh& mesh = surface.mesh();
  edge_ = h;
  size_ = 0;
  // A vertex on the boundary is constrained.
  has_smooth_ends_ = surface.constraint(mesh.origin(h)) == VertexConstraint::free &&
                     surface.constraint(mesh.target(h)) == VertexConstraint::free;
  const bool is_open =
      !has_smooth_ends_ && (mesh.is_boundary(mesh.origin(h)) || mesh.is_boundary(mesh.target(h)));
  is_closed_ = !is_open;
  const bool is_whole = is_open ? gather_open(mesh, limit) : gather_closed(mesh, limit);
  // A closed ring, and one that was cut short, ends with its first neighbor.
  if (size_ > 0 && (is_closed_ || !is_whole)) ring_[size_] = ring_[0];
  is_smooth_ = is_closed_ && has_smooth_ring(surface);
  return is_whole;
}

bool Fan::has_smooth_ring(const Surface& surface) const {
  if (!surface.is_constrained()) return true;
  bool is_smooth = has_smooth_ends_;
  for (const Vertex v : ring())
    is_smooth &= surface.constraint(v) == VertexConstraint::free;
  return is_smooth;
}

bool Fan::gather_closed(const Mesh& mesh, std::size_t limit) {
  const Halfedge t = mesh.twin(edge_);
  const Halfedge end_at_origin = Mesh::next(t);
  const Halfedge end = Mesh::next(edge_);
  const Halfedge first_at_target = mesh.rotate_ccw(t);
  // One loop around both ends of the edge, with a branch-free jump from one to the other. Not a
  // circulator over MergedView: its branches where the edge's faces are would be unpredictable.
  const std::uint32_t jump = end_at_origin.index() ^ first_at_target.index();
  const auto onward = [&](Halfedge s) {
    return Halfedge(s.index() ^ (jump & (0U - static_cast<std::uint32_t>(s == end_at_origin))));
  };
  std::size_t n = 0;
  ring_[0] = mesh.origin(Mesh::prev(edge_));
  Halfedge s = onward(mesh.rotate_ccw(edge_));
  for (; s != end && n < limit; ++n) {
    if (n + kLanes >= spokes_.size()) reserve(2 * n);
    const Halfedge back = Mesh::prev(s);
    spokes_[n] = s;
    ring_[n + 1] = mesh.origin(back);
    s = onward(mesh.twin(back));
  }
  size_ = n;
  return s == end;
}

bool Fan::append(const Mesh& mesh, Halfedge spoke, std::size_t limit) {
  if (size_ == limit) return false;
  if (size_ + kLanes >= spokes_.size()) reserve(2 * size_);
  spokes_[size_] = spoke;
  ring_[size_] = mesh.target(spoke);
  ++size_;
  return true;
}

bool Fan::gather_open(const Mesh& mesh, std::size_t limit) {
  const MergedView merged(mesh, edge_);
  Halfedge start = merged.any();
  if (!start.is_valid()) return true;
  std::size_t steps = 0;
  for (Circulator<MergedView, Turn::cw> back(merged, start); back.advance(); start = *back) {
    if (++steps > limit) return false;
  }
  Circulator at(merged, start);
  do {
    if (!append(mesh, *at, limit)) return false;
  } while (at.advance());
  ring_[size_] = mesh.origin(Mesh::prev(spokes_[size_ - 1]));
  return true;
}

bool Fan::has_repeated_neighbor() const {
  const auto neighbors = ring().first(is_closed_ ? size_ : std::min(size_ + 1, ring().size()));
  // In most cases the lowest bits already differ.
  std::array<std::uint64_t, 4> seen{};
  bool is_met_twice = false;
  for (const Vertex v : neighbors) {
    std::uint64_t& word = seen[v.index() >> 6U & 3U];
    const std::uint64_t bit = std::uint64_t{1} << (v.index() & 63U);
    is_met_twice |= (word & bit) != 0;
    word |= bit;
  }
  if (!is_met_twice) return false;
  std::vector<Vertex> sorted(neighbors.begin(), neighbors.end());
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

Rejection Fan::check_topology(const Surface& surface) const {
  if (!has_smooth_ends_ && !keeps_boundary(surface.mesh())) return Rejection::boundary;
  // Two faces around a closed vertex would have the same corners: a flattened tetrahedron.
  if (is_closed_ && size_ < 3) return Rejection::link_condition;
  return has_repeated_neighbor() ? Rejection::link_condition : kLegal;
}

/// Returns whether the collapse neither joins two parts of the boundary nor removes a face attached
/// by only one side.
bool Fan::keeps_boundary(const Mesh& mesh) const {
  const Halfedge t = mesh.twin(edge_);
  const bool is_open_at_both =
      mesh.is_boundary(mesh.origin(edge_)) && mesh.is_boundary(mesh.target(edge_));
  if (t.is_valid() && is_open_at_both) return false;
  for (const Halfedge side : {edge_, t}) {
    if (side.is_valid() && mesh.is_boundary(Mesh::next(side)) &&
        mesh.is_boundary(Mesh::prev(side))) {
      return false;
    }
  }
  return true;
}

/// Four faces: the positions of their five neighbors, and the shapes of the faces and of those
/// across their outer edges. Lanes past the last face repeat it.
struct Fan::Block {
  Vec3<Float4> first;   ///< position of the neighbor where each face begins
  Vec3<Float4> second;  ///< position of the neighbor where each face ends
  ShapeLanes before;
  ShapeLanes beyond;  ///< the face itself if there is none across
  Vec3<Float4> original;
};

Fan::Block Fan::load(const Surface& surface, std::size_t i) const {
  const Mesh& mesh = surface.mesh();
  std::array<Face, 4> faces;
  std::array<Face, 4> outer;
  std::array<Float4, 4> rows;
  const auto position_row = [&](std::size_t k) {
    return load4(&surface.state(ring_[k]).quadric.g.z);
  };
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const std::size_t k = std::min(i + lane, size_ - 1);
    const Halfedge beyond = mesh.twin(Mesh::next(spokes_[k]));
    faces[lane] = Mesh::face(spokes_[k]);
    outer[lane] = beyond.is_valid() ? Mesh::face(beyond) : faces[lane];
    rows[lane] = position_row(k);
  }
  // Lanes past the last face begin at the last neighbor but one, as it does, and end at the last
  // one.
  const Float4 last = position_row(std::min(i + 4, size_));
  std::array<Float4, 4> ends{rows[1], rows[2], rows[3], last};
  for (std::size_t lane = 0; lane < 4; ++lane) {
    if (i + lane + 1 >= size_) ends[lane] = last;
  }
  transpose(rows[0], rows[1], rows[2], rows[3]);
  transpose(ends[0], ends[1], ends[2], ends[3]);
  return {{rows[1], rows[2], rows[3]},
          {ends[1], ends[2], ends[3]},
          surface.shapes(faces),
          surface.shapes(outer),
          surface.first_normals(faces)};
}

Rejection Fan::check_shape(const Surface& surface, const glm::vec3& p) {
  const auto all = [](float x) { return broadcast<Float4>(x); };
  const Vec3<Float4> center{all(p.x), all(p.y), all(p.z)};
  // Faces past the last one are ignored.
  const auto is_in_fan = [&](std::size_t i) {
    return Int4{0, 1, 2, 3} < static_cast<std::int32_t>(size_ - i);
  };
  Float4 turned{};
  Int4 is_bad{};
  Int4 is_folded{};
  for (std::size_t i = 0; i < size_; i += 4) {
    const Block block = load(surface, i);
    store4(&neighbor_x_[i], block.first.x);
    store4(&neighbor_y_[i], block.first.y);
    store4(&neighbor_z_[i], block.first.z);
    const Vec3<Float4> a = block.first - center;
    const Vec3<Float4> b = block.second - center;
    const Vec3<Float4> c = b - a;
    const UnitAndArea<Float4> after = unit_and_area(a, b);
    store4(&x_[i + 1], after.unit.x);
    store4(&y_[i + 1], after.unit.y);
    store4(&z_[i + 1], after.unit.z);
    store4(&area_[i + 1], after.area);
    const Float4 longest = greater_of(greater_of(dot(a, a), dot(b, b)), dot(c, c));
    const Int4 is_thin =
        (after.area <= longest * all(kLeastAspect)) & (after.area < block.before.area);
    // A face without area may get area in any orientation.
    const Int4 has_area = block.before.area > all(0.0F);
    const Float4 step = dot(after.unit, block.before.normal);
    is_bad |= (is_thin | (step < all(kLeastCosine))) & has_area;
    const Float4 limit = all(kTurnedCosineOfAll);
    const Int4 is_turned_at_last = (dot(after.unit, block.original) < limit) &
                                   ~(dot(block.before.normal, block.original) < limit);
    const Int4 is_turned = ((step < all(kTurnedCosine)) | is_turned_at_last) & has_area;
    const Float4 compact = compact_area(after.area, longest);
    store4(&compact_area_[i + 1], compact);
    turned = turned + select(is_turned & is_in_fan(i), compact, all(0.0F));
    // Adjacent faces within the block; pairs across blocks follow below.
    const auto onward = [](Float4 v) { return __builtin_shufflevector(v, v, 1, 2, 3, 3); };
    const Vec3<Float4> next{onward(after.unit.x), onward(after.unit.y), onward(after.unit.z)};
    is_folded |= (dot(after.unit, block.beyond.normal) < all(kFoldedCosine)) |
                 (dot(after.unit, next) < all(kFoldedCosine));
  }
  if (any(is_bad)) return Rejection::fold_over;
  pad_positions(surface);
  turned_area_ = turned[0] + turned[1] + turned[2] + turned[3];
  x_[0] = x_[size_];
  y_[0] = y_[size_];
  z_[0] = z_[size_];
  area_[0] = area_[size_];
  compact_area_[0] = compact_area_[size_];
  bool may_fold = any(is_folded);
  for (std::size_t i = is_closed_ ? 0 : 4; i < size_; i += 4)
    may_fold |= glm::dot(shape(i).normal, shape_before(i).normal) < kFoldedCosine;
  if (may_fold) {
    const float folded = folded_area_after(surface) - folded_area_before(surface);
    turned_area_ += kFoldWeight * std::max(folded, 0.0F);
  }
  return kLegal;
}

/// Writes the last neighbor's position, repeated for lanes past the last face.
void Fan::pad_positions(const Surface& surface) {
  if (size_ == 0) return;
  const Vec3<float>& last = surface.state(ring_[size_]).position;
  for (std::size_t i = size_; i < size_ + 5; ++i) {
    neighbor_x_[i] = last.x;
    neighbor_y_[i] = last.y;
    neighbor_z_[i] = last.z;
  }
}

float Fan::folded_area_after(const Surface& surface) const {
  const Mesh& mesh = surface.mesh();
  float area = 0.0F;
  for (std::size_t i = 0; i < size_; ++i) {
    const Halfedge beyond = mesh.twin(Mesh::next(spokes_[i]));
    const Side side{shape(i).normal, compact_area_[i + 1]};
    if (beyond.is_valid()) area += folded_area(side, side_of(surface, Mesh::face(beyond)));
    if (is_closed_ || i > 0) area += folded_area(side, {shape_before(i).normal, compact_area_[i]});
  }
  return area;
}

float Fan::folded_area_before(const Surface& surface) const {
  const Mesh& mesh = surface.mesh();
  float area = 0.0F;
  const auto add = [&](Halfedge h) {
    const Halfedge t = mesh.twin(h);
    if (!t.is_valid()) return;
    area += folded_area(side_of(surface, Mesh::face(h)), side_of(surface, Mesh::face(t)));
  };
  for (const Halfedge spoke : spokes()) {
    add(Mesh::next(spoke));
    add(spoke);
  }
  // Edges that are not spokes of a remaining face: the collapsed edge, and the spokes clockwise of
  // it.
  const Halfedge t = mesh.twin(edge_);
  add(edge_);
  add(Mesh::next(edge_));
  if (t.is_valid()) add(Mesh::next(t));
  return area;
}

}  // namespace mesher::simplify
