#pragma once

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// A mesh with its attributes: the parts of a model that edits change.
struct Shape {
  Mesh mesh;
  Attributes attributes;
};

}  // namespace mesher
