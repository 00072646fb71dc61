#pragma once

#include <string>

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"
#include "engine/mesh/report.h"

namespace mesher {

/// A mesh with everything its file said, and what opening it took.
struct Model {
  std::string name;  ///< as a title: the file's name without folder
  Mesh mesh;
  Attributes attributes;
  BuildReport report;
};

}  // namespace mesher
