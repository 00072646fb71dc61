#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>

#include "engine/io/mapped_file.h"
#include "engine/io/mtl_look.h"
#include "engine/mesh/contents.h"
#include "engine/mesh/material.h"

namespace mesher::io {

/// Limits on the MTL files of a model, and on their materials and images. What lies beyond is not
/// read, and a warning says so.
inline constexpr std::size_t kMostMtlBytes = std::size_t{1} << 24;
inline constexpr std::size_t kMostMtlMaterials = std::size_t{1} << 16;
inline constexpr std::size_t kMostMtlImages = std::size_t{1} << 14;

/// Reads MTL files into the materials of a model.
class MtlReader {
 public:
  /// `contents` gets the warnings.
  MtlReader(Materials& materials, FileContents& contents)
      : materials_(materials), contents_(contents) {}

  /// Adds the materials of a file, with all lines as written and with what they are in terms of
  /// glTF (engine/io/mtl_look.h). A malformed statement is kept but means nothing, and gives a
  /// warning with its line. The images have paths but no bytes yet. Comments before the first
  /// material are dropped. O(bytes). Throws InputError if the file is too large or
  /// its text is UTF-16.
  void read(const MappedFile& file);

 private:
  void read_line(std::string_view line);
  void begin_material(std::string_view name);
  void end_material();
  std::uint32_t image_of(std::string_view file);
  void warn(std::string_view reason);

  Materials& materials_;
  FileContents& contents_;
  std::optional<MtlLook> look_;  ///< of the last material, while it is read
  std::unordered_map<std::string, std::uint32_t> images_;
  std::string file_;  ///< its name without folder
  std::uint64_t line_ = 0;
  std::size_t bytes_ = 0;
  bool is_full_ = false;  ///< there are no more than kMostMtlMaterials
};

}  // namespace mesher::io
