#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/progress.h"
#include "engine/mesh/build/build.h"
#include "engine/mesh/build/soup.h"
#include "engine/mesh/model.h"

namespace mesher::io {

/// A moment of an animation.
struct PoseChoice {
  /// The animation's name, or its index in the file, from 0. The name counts first; of several
  /// animations with that name, the first one is meant.
  std::string animation;
  double time_s = 0.0;  ///< before its start and after its end, the first and last pose hold
};

struct ReadOptions {
  /// Base of the vertex numbers in the `e` lines of an OBJ, 0 or 1. Unset: the base for which more
  /// of the listed pairs are edges; 0 if both give the same number.
  std::optional<int> crease_index_base;
  bool keep_isolated_vertices = false;
  /// Vertices at most this far apart are joined, in model units. 0: those at equal positions.
  /// Unset: none.
  std::optional<double> weld = 0.0;
  /// Read a file with a scene as a model with Model::scene, which holds each mesh once. Otherwise a
  /// model is all that the scene shows.
  bool keeps_scene = false;
  /// Unset: the nodes as the file has them. Only formats with animations have poses to choose
  /// (FormatInfo::has_animations); others are refused.
  std::optional<PoseChoice> pose = std::nullopt;
  Progress* progress = nullptr;
};

/// Reads the polygons of a file, in the format of its extension, matched without case, and joins
/// vertices at equal positions (ReadOptions::weld), whatever the format.
///
/// All readers check every count against the file's bytes before they allocate, preserve every bit
/// of a position, keep shared vertices shared, and note what else the file holds.
/// engine/io/*_read.h say what each reader supports. Throws InputError with file, line (in text
/// formats) and reason; DeviceError if out of memory; Cancelled.
Soup read_soup(const std::filesystem::path& file, const ReadOptions& options = {});

/// Reads a file and builds the mesh. Throws the same errors as read_soup.
Model read_model(const std::filesystem::path& file, const ReadOptions& options = {});

}  // namespace mesher::io
