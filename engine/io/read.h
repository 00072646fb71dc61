#pragma once

#include <filesystem>
#include <optional>

#include "engine/core/progress.h"
#include "engine/mesh/build.h"
#include "engine/mesh/model.h"
#include "engine/mesh/soup.h"

namespace mesher {

struct ReadOptions {
  /// Whether the `e` lines of an OBJ count vertices from 0 or 1; unset: decided by which base makes
  /// every listed pair an edge, 0 where both do.
  std::optional<int> crease_index_base;
  bool keep_isolated_vertices = false;
  Progress* progress = nullptr;
};

/// The polygons of a file, unrepaired: OBJ, PLY, STL, OFF, glTF or GLB, as the extension says, in
/// any case. All readers are ours: they check every count against the bytes before they allocate,
/// keep every bit of a position, and keep vertices shared (see engine/io/*_read.h for what each
/// takes over). Throws InputError with file, line (where the format has lines) and reason;
/// DeviceError where memory runs out; Cancelled.
Soup read_soup(const std::filesystem::path& file, const ReadOptions& options = {});

/// Reads a file and builds the mesh. Throws as read_soup.
Model read_model(const std::filesystem::path& file, const ReadOptions& options = {});

}  // namespace mesher
