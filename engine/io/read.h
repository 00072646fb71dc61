#pragma once

#include <filesystem>
#include <optional>

#include "engine/core/progress.h"
#include "engine/mesh/build/build.h"
#include "engine/mesh/build/soup.h"
#include "engine/mesh/model.h"

namespace mesher::io {

struct ReadOptions {
  /// Base of the vertex numbers in the `e` lines of an OBJ, 0 or 1. Unset: the base for which more
  /// of the listed pairs are edges; 0 if both give the same number.
  std::optional<int> crease_index_base;
  bool keep_isolated_vertices = false;
  Progress* progress = nullptr;
};

/// Reads the polygons of a file unchanged, in the format of its extension, matched without case.
///
/// All readers check every count against the file's bytes before they allocate, preserve every bit
/// of a position, and keep shared vertices shared. engine/io/*_read.h say what each reader
/// supports. Throws InputError with file, line (in text formats) and reason; DeviceError if out of
/// memory; Cancelled.
Soup read_soup(const std::filesystem::path& file, const ReadOptions& options = {});

/// Reads a file and builds the mesh. Throws the same errors as read_soup.
Model read_model(const std::filesystem::path& file, const ReadOptions& options = {});

}  // namespace mesher::io
