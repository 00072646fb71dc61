#pragma once

#include <gtest/gtest.h>

#include "engine/mesh/corner_attributes.h"
#include "engine/mesh/validate.h"

namespace mesher::test {

/// Returns the attributes of a model, or of anything with a mesh and attributes, by corner.
template <class T>
CornerAttributes corners_of(const T& model) {
  return to_corners(model.mesh, model.attributes);
}

/// Expects that the attributes of a model, or of anything with a mesh and attributes, are valid.
template <class T>
void expect_valid_attributes(const T& model) {
  for (const Violation& violation : validate(model.mesh, model.attributes))
    ADD_FAILURE() << "invariant " << violation.invariant << ": " << violation.what;
}

}  // namespace mesher::test
