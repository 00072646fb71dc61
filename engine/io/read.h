#pragma once

#include <filesystem>
#include <optional>

#include "engine/core/progress.h"
#include "engine/mesh/build.h"
#include "engine/mesh/model.h"
#include "engine/mesh/soup.h"

namespace mesher {

struct ReadOptions {
  /// Whether the `e` lines of an OBJ count vertices from 0 or 1. Unset: the base for which every
  /// listed pair is an edge; 0 if both are.
  std::optional<int> crease_index_base;
  bool keep_isolated_vertices = false;
  Progress* progress = nullptr;
};

/// Reads the polygons of a file as they are, in the format that the extension names, in any case.
/// All readers check every count against the file's bytes before they allocate, keep every bit of a
/// position, and keep shared vertices shared (engine/io/*_read.h say what each takes over). Throws
/// InputError with file, line (in text formats) and reason; DeviceError if memory runs out;
/// Cancelled.
Soup read_soup(const std::filesystem::path& file, const ReadOptions& options = {});

/// Reads a file and builds the mesh. Throws as read_soup.
Model read_model(const std::filesystem::path& file, const ReadOptions& options = {});

}  // namespace mesher
