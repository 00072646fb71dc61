#pragma once

#include <functional>
#include <vector>

#include "engine/io/gltf_file.h"

namespace mesher::io {

/// Which accessors and buffer views of a document something refers to.
struct GltfUses {
  std::vector<bool> accessors;
  std::vector<bool> views;
};

/// Returns what a document refers to, except for its primitives with `is_replaced(mesh, primitive)`
/// and what only they use. An integer anywhere in an extension that mesher does not know may be a
/// reference, and counts as one. O(document). Throws InputError if it is nested too deeply.
GltfUses find_uses(const GltfFile& gltf,
                   const std::function<bool(std::size_t, std::size_t)>& is_replaced);

/// Refuses a document that is nested so deeply that copying or writing it could exhaust the stack.
/// O(document). Throws InputError.
void check_depth(const GltfFile& gltf);

/// Returns whether objects of the document have an extension of this name.
bool has_extension(const GltfFile::Json& root, std::string_view name);

}  // namespace mesher::io
