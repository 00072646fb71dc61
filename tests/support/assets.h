#pragma once

#include <string>

#include "engine/io/read.h"
#include "engine/mesh/mesh.h"

namespace mesher::test {

/// The mesh of a file of assets/: "bunny.obj".
inline Mesh asset(const std::string& name) {
  return io::read_model(MESHER_SOURCE_DIR "/assets/" + name).mesh;
}

}  // namespace mesher::test
