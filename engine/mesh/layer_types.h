#pragma once

#include "engine/mesh/attributes.h"

namespace mesher {

/// Returns a type that holds the values of both, whose names and kinds agree: floats if their
/// components differ, and indices of joints in 16 bits.
AttributeType common_type(AttributeType a, const AttributeType& b);

/// Appends values of another type. Missing components are 0, alpha is 1.
void append_converted(AttributeLayer& to, const AttributeLayer& from);

}  // namespace mesher
