#pragma once

#include <glm/vec3.hpp>

#include "engine/core/array.h"

namespace mesher::io {

/// Returns the origin about which a reader should store positions in single precision: 0, unless
/// positions about zero are further from the file's numbers than the longest side of their box
/// times 2^-24. Maps and surveys have such numbers: meters from the equator, of an object of some
/// meters.
///
/// `positions` are about zero, and `error` is the largest distance of a coordinate from its number
/// in the file. Each coordinate of the origin is a multiple of a power of two near the box's size,
/// so that subtracting it in double precision is exact. O(V), parallel.
glm::dvec3 choose_origin(const Array<glm::vec3>& positions, double error);

/// A coordinate of a position about an origin, to be written as text.
struct FarCoordinate {
  double origin;
  float local;
  double value() const { return origin + static_cast<double>(local); }
};

/// Writes the shortest decimal that choose_origin's reader turns back into `local`: at most 25
/// characters. Returns the end.
char* write_far_coordinate(const FarCoordinate& coordinate, char* begin, char* end);

}  // namespace mesher::io
