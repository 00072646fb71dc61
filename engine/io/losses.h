#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// Returns what write_model leaves out or changes because the format cannot hold it, in a person's
/// words ("3 creases", "normals (they differ around vertices)"). Empty: the file holds everything.
/// O(F).
std::vector<std::string> losses_in_format(const std::filesystem::path& file, const Mesh& mesh,
                                          const Attributes& attributes);

}  // namespace mesher
