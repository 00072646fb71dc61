#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

#include "engine/mesh/corner_attributes.h"
#include "engine/mesh/validate.h"

namespace mesher::test {

/// Returns the attributes of a model, or of anything with a mesh and attributes, by corner.
template <class T>
CornerAttributes corners_of(const T& model) {
  return to_corners(model.mesh, model.attributes);
}

/// Returns groups with these names and nothing else.
inline std::vector<FaceGroup> named_groups(std::initializer_list<const char*> names) {
  std::vector<FaceGroup> groups;
  for (const char* name : names)
    groups.push_back({.name = name});
  return groups;
}

/// Expects that the attributes of a model, or of anything with a mesh and attributes, are valid.
template <class T>
void expect_valid_attributes(const T& model) {
  for (const Violation& violation : validate(model.mesh, model.attributes))
    ADD_FAILURE() << "invariant " << violation.invariant << ": " << violation.what;
}

}  // namespace mesher::test
