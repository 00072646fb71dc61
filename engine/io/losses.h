#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher::io {

/// Returns what write_model omits or changes because the format cannot store it, as phrases for the
/// user ("3 creases", "normals (they differ around vertices)"). Empty: the file preserves
/// everything. O(F).
std::vector<std::string> losses_in_format(const std::filesystem::path& file, const Mesh& mesh,
                                          const Attributes& attributes);

}  // namespace mesher::io
