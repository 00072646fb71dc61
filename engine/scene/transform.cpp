#include "engine/scene/transform.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "engine/mesh/parts.h"

namespace mesher::scene {
namespace {

enum class Vector { none, direction, normal, tangent, change_of_position, change_of_normal };

/// What a layer's values are in space. Layers of morph targets are named "target 0 POSITION".
Vector vector_of(const AttributeType& type) {
  if (type.components < 3) return Vector::none;
  if (type.kind == AttributeKind::normal) return Vector::normal;
  if (type.kind == AttributeKind::tangent) return Vector::tangent;
  if (type.kind != AttributeKind::delta) return Vector::none;
  if (type.name.ends_with(" POSITION")) return Vector::change_of_position;
  if (type.name.ends_with(" NORMAL")) return Vector::change_of_normal;
  return type.name.ends_with(" TANGENT") ? Vector::change_of_position : Vector::none;
}

glm::dvec3 with_length(const glm::dvec3& v, double length) {
  const double own = glm::length(v);
  return own > 0.0 ? v * (length / own) : v;
}

}  // namespace

bool is_invertible(const glm::dmat4& transform) {
  double volume = 1.0;
  for (int i = 0; i < 3; ++i)
    volume *= glm::length(glm::dvec3(transform[i]));
  const double determinant = std::abs(glm::determinant(glm::dmat3(transform)));
  constexpr double kFlattest = 1e-6;  // of single precision, half of the digits remain
  return std::isnormal(volume) && determinant > kFlattest * volume;
}

void apply(const glm::dmat4& transform, Shape& shape) {
  if (transform == glm::dmat4(1.0)) return;
  const glm::dmat3 linear(transform);
  if (glm::determinant(linear) < 0.0) turn_over(shape);
  MeshArrays arrays = MeshArrays::take(std::move(shape.mesh));
  for (glm::vec3& p : arrays.position)
    p = glm::vec3(transform * glm::dvec4(glm::dvec3(p), 1.0));
  shape.mesh = std::move(arrays).finish();
  if (linear == glm::dmat3(1.0)) return;
  for (AttributeLayer& layer : shape.attributes.layers) {
    for (std::size_t i = 0; i < layer.count() && has_direction(layer.type()); ++i)
      transform_value(linear, layer, i);
  }
}

bool has_direction(const AttributeType& type) {
  return vector_of(type) != Vector::none;
}

void transform_value(const glm::dmat3& linear, AttributeLayer& layer, std::size_t i) {
  const Vector vector = vector_of(layer.type());
  if (is_absent(layer, i)) return;
  AttributeValue value = load(layer, i);
  const glm::dvec3 before(value[0], value[1], value[2]);
  const bool is_normal = vector == Vector::normal || vector == Vector::change_of_normal;
  glm::dvec3 after = (is_normal ? normal_transform(linear) : linear) * before;
  // Only changes of positions may have another length.
  if (vector != Vector::change_of_position) after = with_length(after, glm::length(before));
  value = {after.x, after.y, after.z, value[3]};
  if (vector == Vector::tangent && glm::determinant(linear) < 0.0) value[3] = -value[3];
  store(layer, i, value);
}

glm::dmat3 normal_transform(const glm::dmat3& linear) {
  return glm::determinant(linear) != 0.0 ? glm::transpose(glm::inverse(linear)) : linear;
}

}  // namespace mesher::scene
