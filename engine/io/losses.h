#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// What write_model would have to leave out or change because the format cannot say it, in a
/// person's words ("3 creases", "normals at seams"). Empty: everything is kept. O(F).
std::vector<std::string> losses_in_format(const std::filesystem::path& file, const Mesh& mesh,
                                          const Attributes& attributes);

}  // namespace mesher
