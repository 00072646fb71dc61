#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "engine/io/atomic_file.h"
#include "engine/io/gltf_write.h"
#include "engine/io/mapped_file.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"
#include "engine/mesh/soup.h"

namespace mesher {

/// How a format holds an attribute that the corners of a mesh have.
enum class Holds {
  nothing,
  one_per_vertex,  ///< if all corners of each vertex agree
  all_or_none,     ///< if no corner lacks it
  each_corner,
};

/// What a format can hold beside positions and faces.
struct FormatContents {
  bool creases = false;
  bool groups = false;
  Holds texcoord = Holds::nothing;
  Holds normal = Holds::nothing;
  Holds color = Holds::nothing;
};

/// A row of the table of formats. To add a format, write its reader and writer and add its row:
/// dialogs, messages, --help, and the report of what a file cannot hold follow from it.
struct FormatInfo {
  const char* name;       ///< "Wavefront OBJ"
  const char* extension;  ///< ".obj", in lower case
  FormatContents holds{};
  /// Reads the polygons of a file that is not empty. Null for progressive meshes, which
  /// engine/io/pm_file.h reads and writes.
  Soup (*read)(const MappedFile& file, const ReadOptions& options) = nullptr;
  void (*write)(AtomicFile& file, const Mesh& mesh, const Attributes& attributes,
                const WriteOptions& options) = nullptr;
  /// Writes several levels of detail into one file; null: a file holds one level.
  void (*write_levels)(AtomicFile& file, std::span<const GltfLevel> levels) = nullptr;
};

/// All formats, in the order in which messages list them.
std::span<const FormatInfo> formats();

/// The format that a file's extension names, in any case; null: none has it.
const FormatInfo* format_of(const std::filesystem::path& file);

/// For messages: "obj, ply, stl, off, gltf, glb or pm", all that can be opened.
std::string readable_formats();
/// For messages: "obj, ply, stl, off, gltf or glb", all that a mesh can be written to.
std::string writable_formats();

/// Readers cut the names of objects, groups and materials to this many bytes, because they join and
/// copy names per face or node: the cost must not grow with a hostile name.
inline constexpr std::size_t kMaxNameBytes = 256;

}  // namespace mesher
