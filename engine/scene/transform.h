#pragma once

#include <glm/mat4x4.hpp>

#include "engine/mesh/shape.h"

namespace mesher::scene {

/// Returns whether a transform loses nothing but digits, so that it can be undone.
bool is_invertible(const glm::dmat4& transform);

/// Moves a shape: positions, normals, tangents and what morph targets add to them. A transform that
/// mirrors also turns the faces over. The identity keeps every bit. O(V + F).
void apply(const glm::dmat4& transform, Shape& shape);

/// Returns whether values of a layer turn with the shape.
bool has_direction(const AttributeType& type);

/// Turns a value of a layer. Pre: it has a direction.
void transform_value(const glm::dmat3& linear, AttributeLayer& layer, std::size_t i);

/// Returns the transform of normals that belongs to one of positions, up to their length.
glm::dmat3 normal_transform(const glm::dmat3& linear);

}  // namespace mesher::scene
