#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/io/atomic_file.h"
#include "engine/io/gltf_write.h"
#include "engine/io/mapped_file.h"
#include "engine/io/material_losses.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/build/soup.h"
#include "engine/mesh/mesh.h"
#include "engine/mesh/model.h"
#include "engine/mesh/shape.h"
#include "engine/scene/scene.h"

namespace mesher::io {

/// How a format stores an attribute of a mesh's corners.
enum class Holds {
  nothing,
  one_per_vertex,  ///< only if all corners of each vertex agree
  all_or_none,     ///< only if every corner has it
  each_corner,
};

/// What a format can store besides positions and faces.
struct FormatContents {
  bool creases = false;
  bool groups = false;  ///< with the names of objects and smoothing groups
  HoldsMaterials materials = HoldsMaterials::nothing;
  bool any_attribute = false;  ///< besides the three below, which every format could have
  bool far_positions = false;  ///< with all digits, also far from zero
  Holds texcoord = Holds::nothing;
  Holds normal = Holds::nothing;
  Holds color = Holds::nothing;
};

/// A row of the table of formats.
///
/// To add a format, write its reader and writer and add its row. Dialogs, messages, --help, and the
/// report of what a file does not preserve are derived from the table.
struct FormatInfo {
  const char* name;       ///< "Wavefront OBJ"
  const char* extension;  ///< ".obj", in lower case
  FormatContents holds{};
  /// Time to read the polygons of a file, relative to building the mesh of them: median of files of
  /// 0.1, 1.4 and 13 million faces on two cores.
  double read_weight = 1.0;
  /// Share of joining vertices in that time.
  double join_part = 0.03;
  /// The reader joins vertices itself: those of each part of the file, not those of different
  /// parts.
  bool joins_itself = false;
  /// The reader takes ReadOptions::pose.
  bool has_animations = false;
  /// Reads the polygons of a file. Pre: the file is not empty. Null for progressive meshes, which
  /// engine/io/pm_file.h reads and writes.
  Soup (*read)(const MappedFile& file, const ReadOptions& options) = nullptr;
  void (*write)(AtomicFile& file, const Mesh& mesh, const Attributes& attributes,
                const WriteOptions& options) = nullptr;
  /// Writes several levels of detail into one file. Null: a file holds one level.
  void (*write_levels)(AtomicFile& file, std::span<const GltfLevel> levels,
                       const WriteOptions& options) = nullptr;
  /// Reads a file as a model with Model::scene, and writes it with the meshes of a shape: see
  /// gltf_model.h. Null: a file holds no scene.
  Model (*read_scene)(const std::filesystem::path& file, const ReadOptions& options) = nullptr;
  std::vector<std::string> (*write_scene)(AtomicFile& file, const Shape& shape,
                                          const scene::Scene& scene, Progress* progress) = nullptr;
};

/// Returns all formats, in the order in which messages list them.
std::span<const FormatInfo> formats();

/// Returns the format of a file's extension (extension_of), matched without case. Null: no format
/// has that extension.
const FormatInfo* format_of(const std::filesystem::path& file);

/// Returns how a file stores materials: as its format does, or not at all if the format needs files
/// beside it and it is a pipe (is_open_file).
HoldsMaterials held_materials(const FormatInfo& format, const std::filesystem::path& file);

/// Returns the formats that can be opened, for messages: "obj, ply, stl, off, gltf, glb or pm".
std::string readable_formats();
/// Returns the formats that a mesh can be written to, for messages: "obj, ply, stl, off, gltf or
/// glb".
std::string writable_formats();

/// Longest name of an object, group or material, in bytes; readers truncate longer names. Readers
/// join and copy names per face or per node, and the limit keeps that cost independent of a hostile
/// name.
inline constexpr std::size_t kMaxNameBytes = 256;

}  // namespace mesher::io
