#pragma once

#include <string>

#include "engine/mesh/attributes.h"
#include "engine/mesh/build/report.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// A mesh with all other data of its file, and the repairs made when it was opened.
struct Model {
  std::string name;  ///< for titles: the file's name without folder
  Mesh mesh;
  Attributes attributes;
  BuildReport report;
};

}  // namespace mesher
