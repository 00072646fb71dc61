// The part of AttributeField that follows a collapse.
#include <algorithm>
#include <span>
#include <vector>

#include "engine/simplify/attribute_field.h"

namespace mesher::simplify {
namespace {

/// Returns spokes i to i + 3 of a fan; those past the last one repeat it.
FourHalfedges four_spokes(const Fan& fan, std::size_t i) {
  const std::span<const Halfedge> all = fan.spokes();
  const auto spoke = [&](std::size_t k) { return all[std::min(k, all.size() - 1)]; };
  return {spoke(i), spoke(i + 1), spoke(i + 2), spoke(i + 3)};
}

Int4 lanes_of(std::uint32_t wedge) {
  return Int4{} + static_cast<std::int32_t>(wedge);
}

}  // namespace

/// What the wedges of `pairs` become by a collapse.
struct AttributeField::Merged {
  Pairs pairs;
  std::array<Values, 2> values;
  std::array<std::uint32_t, 2> source{kNone, kNone};
  /// Wedges aside whose values change, by a collapse across seams.
  struct Extended {
    std::uint32_t wedge;
    Values values;
  };
  std::vector<Extended> extended;

  // Where both sides have a wedge in common, the first one counts.

  /// Returns what wedges at the edge's ends become: those at its origin change.
  Int4 names_after(Int4 wedges) const {
    Int4 names = wedges;
    for (std::size_t i = pairs.count; i-- > 0;) {
      const auto& [origin, target] = pairs.pair[i];
      names = select(wedges == lanes_of(origin), lanes_of(target), names);
    }
    return names;
  }
  std::uint32_t name_after(std::uint32_t wedge) const {
    return static_cast<std::uint32_t>(names_after(lanes_of(wedge))[0]);
  }
  /// Returns the values of a number for wedges of these names; `before` if they do not change.
  Float4 values_after(Int4 names, std::size_t number, Float4 before) const {
    Float4 after = before;
    for (std::size_t i = pairs.count; i-- > 0;) {
      after = select(names == lanes_of(pairs.pair[i].target), broadcast<Float4>(values[i][number]),
                     after);
    }
    for (const Extended& wedge : extended)
      after =
          select(names == lanes_of(wedge.wedge), broadcast<Float4>(wedge.values[number]), after);
    return after;
  }
};

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
  if (surface.allowed_placement(h) == AllowedPlacement::across) {
    for (const bool is_target : {false, true})
      extend_aside(surface, h, is_target, p, result);
  }
  return result;
}

/// Extends the wedges of an end of `h` that are not at the edge to `p`. Where a seam of the texture
/// alone separates them from the edge, they get the other numbers of the merged vertex.
void AttributeField::extend_aside(const Surface& surface, Halfedge h, bool is_target,
                                  const glm::vec3& p, Merged& merged) const {
  const Mesh& mesh = surface.mesh();
  const Vertex v = is_target ? mesh.target(h) : mesh.origin(h);
  if (p == mesh.position(v)) return;
  const glm::vec3 y = p - mesh.position(v);
  const Float4 along{y.x, y.y, y.z, 0.0F};
  const Aside beside = aside(mesh, v, merged.pairs);
  for (const std::uint32_t wedge : beside.all()) {
    const float* const s = record(wedge);
    Merged::Extended& extended = merged.extended.emplace_back();
    extended.wedge = wedge;
    for (std::size_t j = 0; j < size_; ++j) {
      const float change = s[0] > 0.0F ? sum_of(load4(s + row(j)) * along) / s[0] : 0.0F;
      extended.values[j] = value(wedge, j) + change;
    }
    for (std::size_t i = 0; i < merged.pairs.count; ++i) {
      const Pair& pair = merged.pairs.pair[i];
      if (!differ_in_texture_only(wedge, is_target ? pair.target : pair.origin)) continue;
      for (std::size_t j = 0; j < size_; ++j) {
        if (!is_texcoord_[j]) extended.values[j] = merged.values[i][j];
      }
      break;
    }
  }
}

bool AttributeField::differ_in_texture_only(std::uint32_t a, std::uint32_t b) const {
  for (std::size_t j = 0; j < size_; ++j) {
    if (!is_texcoord_[j] && value(a, j) != value(b, j)) return false;
  }
  return true;
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
  for (const Halfedge spoke : fan.spokes())
    will_need(wedge_[Mesh::prev(spoke).index()]);
  const Merged merged = this->merged(surface, h, p);
  const Float4 zero = broadcast<Float4>(0.0F);
  Int4 flips{};
  for (std::size_t i = 0; i < fan.size(); i += 4) {
    const FourWedges corners = wedges(four_spokes(fan, i));
    const Int4 names = merged.names_after(corners[0]);
    for (const std::size_t j : texcoords_) {
      const Float4 u = values(corners[0], j);
      const Float4 v = values(corners[0], j + 1);
      const Float4 u1 = values(corners[1], j);
      const Float4 v1 = values(corners[1], j + 1);
      const Float4 u2 = values(corners[2], j);
      const Float4 v2 = values(corners[2], j + 1);
      const auto area = [&](Float4 u0, Float4 v0) {
        return (u1 - u0) * (v2 - v0) - (v1 - v0) * (u2 - u0);
      };
      const Float4 before = area(u, v);
      const Float4 after =
          area(merged.values_after(names, j, u), merged.values_after(names, j + 1, v));
      flips |= (before != zero) & ((after == zero) | ((before > zero) != (after > zero)));
    }
  }
  return any(flips);
}

/// Clears the sums; the values stay.
void AttributeField::clear(std::uint32_t wedge) {
  float* to = record(wedge);
  for (std::size_t k = 0; k < stride_; k += 4)
    store4(to + k, Float4{0.0F, 0.0F, 0.0F, k < row(0) ? 0.0F : to[k + 3]});
}

/// Takes the faces at an edge from the sums of the wedges across from it.
void AttributeField::remove_faces_at(const Surface& surface, Halfedge h) {
  const Halfedge twin = surface.mesh().twin(h);
  FourHalfedges across;
  across.fill(Mesh::prev(h));
  if (twin.is_valid()) across[1] = Mesh::prev(twin);
  FourFaces faces;
  load(surface, across, faces);
  FourContributions contributions;
  contributions.set(faces, size_);
  for (std::size_t face = 0; face < (twin.is_valid() ? 2 : 1); ++face) {
    float* const to = record(faces.wedge_at(0, face));
    for (std::size_t k = 0; k < stride_; k += 4)
      store4(to + k, load4(to + k) - contributions.row(k / 4, face));
  }
}

void AttributeField::collapsing(const Surface& surface, Halfedge h, const Fan& fan,
                                const glm::vec3& p) {
  const Merged merged = this->merged(surface, h, p);
  remove_faces_at(surface, h);
  // The wedges of the merged vertex are summed anew.
  std::uint32_t cleared = kNone;
  for (const Halfedge spoke : fan.spokes()) {
    const std::uint32_t wedge = merged.name_after(wedge_[spoke.index()]);
    if (wedge != cleared) clear(wedge);
    cleared = wedge;
  }
  const auto all = [](float x) { return broadcast<Float4>(x); };
  FourFaces faces;
  FourContributions before, after;
  for (std::size_t i = 0; i < fan.size(); i += 4) {
    const FourHalfedges spokes = four_spokes(fan, i);
    load(surface, spokes, faces);
    before.set(faces, size_);
    faces.position[0] = {all(p.x), all(p.y), all(p.z)};
    faces.wedge[0] = merged.names_after(faces.wedge[0]);
    for (std::size_t j = 0; j < size_; ++j)
      faces.values[0][j] = merged.values_after(faces.wedge[0], j, faces.values[0][j]);
    after.set(faces, size_);
    for (std::size_t face = 0; face < std::min<std::size_t>(4, fan.size() - i); ++face) {
      wedge_[spokes[face].index()] = faces.wedge_at(0, face);
      float* const center = record(faces.wedge_at(0, face));
      float* const first = record(faces.wedge_at(1, face));
      float* const second = record(faces.wedge_at(2, face));
      for (std::size_t k = 0; k < stride_; k += 4) {
        const Float4 added = after.row(k / 4, face);
        const Float4 change = added - before.row(k / 4, face);
        store4(center + k, load4(center + k) + added);
        store4(first + k, load4(first + k) + change);
        store4(second + k, load4(second + k) + change);
      }
    }
  }
  for (std::size_t i = 0; i < merged.pairs.count; ++i) {
    const std::uint32_t wedge = merged.pairs.pair[i].target;
    for (std::size_t j = 0; j < size_; ++j)
      record(wedge)[row(j) + 3] = merged.values[i][j];
    source_[wedge] = merged.source[i];
  }
  for (const Merged::Extended& extended : merged.extended) {
    for (std::size_t j = 0; j < size_; ++j)
      record(extended.wedge)[row(j) + 3] = extended.values[j];
    source_[extended.wedge] = kNone;
  }
  if (surface.allowed_placement(h) == AllowedPlacement::across)
    has_crossed_seams_.store(true, std::memory_order_relaxed);
}

}  // namespace mesher::simplify
