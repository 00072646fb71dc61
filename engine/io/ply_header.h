#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/io/mapped_file.h"

namespace mesher::io {

enum class PlyEncoding { text, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Returns the size in bytes of a value in the binary encodings.
std::size_t size_of(PlyType type);
inline bool is_whole(PlyType type) {
  return type < PlyType::float32;
}

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;    ///< type of the value, or of each list item
  std::optional<PlyType> count_type;  ///< set for a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< as the header says; do not trust it
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::text;
  std::vector<PlyElement> elements;
  const char* data = nullptr;         ///< first byte after the header
  std::vector<std::string> textures;  ///< files of MeshLab's comments `TextureFile`
  std::uint64_t skipped_lines = 0;    ///< that the format does not define
};

/// Reads the header of a PLY file with any kind of line end. Skips a byte order mark, and lines
/// with an unknown keyword. Throws InputError with the line.
PlyHeader read_ply_header(const MappedFile& file);

}  // namespace mesher::io
