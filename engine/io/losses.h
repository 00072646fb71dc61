#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "engine/mesh/attributes.h"
#include "engine/mesh/contents.h"
#include "engine/mesh/material.h"
#include "engine/mesh/mesh.h"

namespace mesher::io {

/// Returns what the written file does not hold, as phrases for the user ("3 creases", "normals
/// (they differ around vertices)", "2 materials: brick, paper"): what the format cannot store of
/// the mesh, and what the model's own file held but mesher does not carry over. Empty: the file
/// preserves everything. O(F).
///
/// `materials` (may be null), `contents` and `origin` are those of the Model that the mesh comes
/// from.
std::vector<std::string> losses_in_format(const std::filesystem::path& file, const Mesh& mesh,
                                          const Attributes& attributes,
                                          const Materials* materials = nullptr,
                                          const FileContents& contents = {},
                                          const glm::dvec3& origin = glm::dvec3(0.0));

}  // namespace mesher::io
