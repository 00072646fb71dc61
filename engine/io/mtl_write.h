#pragma once

#include <string>
#include <vector>

#include "engine/io/atomic_file.h"
#include "engine/mesh/material.h"

namespace mesher::io {

/// How an OBJ refers to its materials.
struct MtlReference {
  std::vector<std::string> libraries;  ///< each for a line of `mtllib`
  std::vector<std::string> names;      ///< of the materials, for `usemtl`: not empty, each once
};

/// Adds an MTL file and the images to an OBJ.
///
/// The file has the OBJ's name and ".mtl". It replaces one of that name if the OBJ is replaced as
/// well or mesher has written it; otherwise it gets another name. Materials have the lines that
/// they were read with, in which only the paths of images may change; others are translated
/// (engine/io/mtl_look.h). A material that is only a name is not in the file: the OBJ refers to the
/// missing files again. Throws OutputError.
MtlReference add_mtl(AtomicFile& obj, const Materials& materials);

}  // namespace mesher::io
