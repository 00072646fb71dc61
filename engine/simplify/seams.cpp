#include "engine/simplify/seams.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/parallel.h"

namespace mesher::simplify {
namespace {

constexpr std::size_t kSeamGrain = std::size_t{1} << 10;

/// Returns a normal of length 1, or the value itself if it has no direction.
glm::dvec3 unit_normal(const AttributeValue& value) {
  const glm::dvec3 n(value[0], value[1], value[2]);
  const double length = glm::length(n);
  return length > 0.0 ? n / length : n;
}

/// Returns the cosine between the normals on both sides of an edge, the smaller of its two ends.
double normal_cosine(const SeamTest& test, const AttributeLayer& normals, const Mesh& mesh,
                     Halfedge h) {
  const Halfedge t = mesh.twin(h);
  const auto normal = [&](Halfedge corner) {
    return unit_normal(load(normals, test.wedge(corner).index()));
  };
  return std::min(glm::dot(normal(h), normal(Mesh::next(t))),
                  glm::dot(normal(Mesh::next(h)), normal(t)));
}

/// Returns whether the faces of an edge differ in material, or belong to different primitives.
bool is_material_border(const Mesh& mesh, const Attributes& attributes, Halfedge h) {
  const Halfedge t = mesh.twin(h);
  if (attributes.group.empty() || !t.is_valid()) return false;
  const std::uint32_t a = attributes.group[Mesh::face(h).index()];
  const std::uint32_t b = attributes.group[Mesh::face(t).index()];
  if (a == b) return false;
  return attributes.groups[a].material != attributes.groups[b].material ||
         attributes.groups[a].primitive != attributes.groups[b].primitive;
}

/// Morph targets that only shade.
bool is_shading_delta(const AttributeType& type) {
  return type.kind == AttributeKind::delta &&
         (type.name.ends_with("NORMAL") || type.name.ends_with("TANGENT"));
}

bool is_line(const SeamTest& test, const Mesh& mesh, const Attributes& attributes, Halfedge h) {
  if (is_material_border(mesh, attributes, h)) return true;
  if (!test.is_seam(h)) return false;
  for (const AttributeLayer& layer : attributes.layers) {
    // A tangent follows from the normal and the texture coordinates.
    if (layer.type().kind == AttributeKind::tangent || is_shading_delta(layer.type())) continue;
    if (!test.is_seam(h, layer)) continue;
    if (layer.type().kind != AttributeKind::normal) return true;
    if (normal_cosine(test, layer, mesh, h) < std::cos(kHardEdgeDegrees * std::numbers::pi / 180.0))
      return true;
  }
  return false;
}

}  // namespace

bool SeamTest::has_value_per_face(const AttributeLayer& layer) const {
  std::size_t seams = 0;
  std::size_t others = 0;
  for (std::uint32_t i = 0; i < mesh_.halfedge_count(); ++i) {
    const Halfedge h(i);
    if (mesh_.is_boundary(h)) continue;
    ++(is_seam(h) && is_seam(h, layer) ? seams : others);
  }
  return seams > others;
}

bool may_have_lines(const Attributes& attributes) {
  const auto is_like_first = [&](const FaceGroup& group) {
    return group.material == attributes.groups.front().material &&
           group.primitive == attributes.groups.front().primitive;
  };
  return attributes.has_seams() || !std::ranges::all_of(attributes.groups, is_like_first);
}

Lines::Lines(const Mesh& mesh, const Attributes& attributes) {
  if (!may_have_lines(attributes)) return;
  const SeamTest test(mesh, attributes);
  is_line_.resize(mesh.halfedge_count());
  parallel_for_each(mesh.halfedge_count(), kSeamGrain, [&](std::uint32_t h) {
    is_line_[h] = is_line(test, mesh, attributes, Halfedge(h)) ? 1 : 0;
  });
}

void mark_seams(Mesh& mesh, const Attributes& attributes) {
  if (!may_have_lines(attributes)) return;
  const SeamTest test(mesh, attributes);
  const MeshArrays::InPlace arrays = MeshArrays::open(mesh);
  parallel_for_each(mesh.halfedge_count(), kSeamGrain, [&](std::uint32_t h) {
    if (!(arrays.sharpness[h] > 0.0F) && is_line(test, mesh, attributes, Halfedge(h)))
      arrays.sharpness[h] = kSeamSharpness;
  });
}

void unmark_seams(Mesh& mesh) {
  const MeshArrays::InPlace arrays = MeshArrays::open(mesh);
  for (float& sharpness : arrays.sharpness) {
    if (sharpness == kSeamSharpness) sharpness = 0.0F;
  }
}

}  // namespace mesher::simplify
