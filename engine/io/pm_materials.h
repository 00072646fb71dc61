#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "engine/mesh/contents.h"
#include "engine/mesh/material.h"

namespace mesher::io {

/// Returns materials as a binary glTF document (.glb) without meshes, in which the images are
/// embedded: what a .pm file holds beside its attributes. Empty if there are none. Throws
/// OutputError for more than 4 GB.
std::string encode_pm_materials(const Materials* materials);

/// Reads such a document. Null if it is empty or damaged; `contents` gets a warning then, and what
/// the materials are. Images may also be files in or below the folder of `file`.
std::shared_ptr<const Materials> decode_pm_materials(std::span<const std::byte> bytes,
                                                     const std::filesystem::path& file,
                                                     FileContents& contents);

}  // namespace mesher::io
