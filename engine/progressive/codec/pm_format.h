#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "engine/mesh/ids.h"

namespace mesher::progressive {

// Bytes, checksums and limits of docs/pm-format.md, shared by writer and reader.

inline constexpr std::array<unsigned char, 8> kPmMagic{0x89, 'M', 'P', 'M', '\r', '\n', 0x1A, '\n'};
inline constexpr std::uint32_t kPmVersion = 1;
/// Version of files with attributes.
inline constexpr std::uint32_t kPmAttributeVersion = 2;
inline constexpr std::uint32_t kPmSharpEdges = 1;
inline constexpr std::uint32_t kPmSharpVertices = 2;
inline constexpr std::uint32_t kPmAttributes = 4;  ///< exactly in version 2
inline constexpr unsigned kPmLeastCoordinateBits = 4;
inline constexpr unsigned kPmMostCoordinateBits = 24;
inline constexpr std::size_t kPmHeaderBytes = 76;
inline constexpr std::size_t kPmBlockHeaderBytes = 12;
inline constexpr std::size_t kPmBaseAttributesHeaderBytes = 16;
inline constexpr std::size_t kPmAttributesHeaderBytes = 8;

// Limits: nothing that a file announces takes memory or time out of proportion to its size.

inline constexpr std::uint32_t kPmMostBlockSplits = 8192;
inline constexpr std::uint32_t kPmMostFan = 65'535;  ///< faces at a parent
/// Returns the minimum number of bytes that may announce this many splits.
constexpr std::uint64_t pm_least_bytes(std::uint64_t splits) {
  return splits <= 8 ? 0 : (splits - 8 + 1) / 2;
}
/// Same, for this many vertices or faces of the base.
constexpr std::uint64_t pm_least_base_bytes(std::uint64_t elements) {
  return elements <= 64 ? 1 : (elements - 64 + 3) / 4;
}
constexpr std::uint64_t pm_most_bytes(std::uint64_t splits) {
  return 128 * splits + 64;
}
/// Maximum for all splits up to the end of a block together; ids of moved corners have 32 bits.
constexpr std::uint64_t pm_most_moved(std::uint64_t splits) {
  return std::min(16 * splits + 65'536, std::uint64_t{kNone});
}
constexpr std::uint64_t pm_most_walked(std::uint64_t splits) {
  return 4096 * splits + (std::uint64_t{1} << 20U);
}
/// Maximum size of all values of attributes, by the size of the payloads that hold them.
constexpr std::uint64_t pm_most_value_bytes(std::uint64_t payload_bytes) {
  return 128 * payload_bytes + 65'536;
}
/// Returns the minimum size of a payload after which there are so many bytes of values, if those
/// before it have `payload_bytes`.
constexpr std::uint64_t pm_least_value_payload(std::uint64_t value_bytes,
                                               std::uint64_t payload_bytes) {
  const std::uint64_t most = pm_most_value_bytes(payload_bytes);
  return value_bytes <= most ? 0 : (value_bytes - most + 127) / 128;
}

/// Quantization grid: a coordinate is `origin + step * number`.
struct PmGrid {
  std::array<double, 3> origin{};
  double step = 0.0;

  glm::vec3 position(const glm::ivec3& p) const {
    return {static_cast<float>(origin[0] + step * p.x), static_cast<float>(origin[1] + step * p.y),
            static_cast<float>(origin[2] + step * p.z)};
  }
  /// Returns the nearest grid point, with `bits` bits per coordinate.
  glm::ivec3 numbers(const glm::vec3& position, unsigned bits) const;
  /// Returns the position of the nearest grid point. Not inline: where g++ 12 converts the result
  /// to double in the same function, it drops the rounding to float (-O3, two at a time).
  [[gnu::noinline]] glm::vec3 nearest(const glm::vec3& position, unsigned bits) const;
};

struct PmHeader {
  std::uint32_t flags = 0;
  std::uint32_t coordinate_bits = 0;
  std::uint32_t base_vertices = 0;
  std::uint32_t base_faces = 0;
  std::uint32_t splits = 0;
  PmGrid grid;
  std::uint32_t base_bytes = 0;  ///< of the base's payload
  std::uint32_t check = 0;       ///< of the header
  std::uint32_t base_check = 0;  ///< of header and base

  bool has_sharp_edges() const { return (flags & kPmSharpEdges) != 0; }
  bool has_sharp_vertices() const { return (flags & kPmSharpVertices) != 0; }
  bool has_attributes() const { return (flags & kPmAttributes) != 0; }
  bool is_quantized() const { return coordinate_bits != 0; }
};

/// The header of the attributes of the base, which follow its payload.
struct PmBaseAttributesHeader {
  std::uint32_t table_bytes = 0;
  std::uint32_t bytes = 0;           ///< of the payload
  std::uint32_t appendix_bytes = 0;  ///< of what the writer added
  std::uint32_t check = 0;

  std::uint64_t total_bytes() const { return std::uint64_t{table_bytes} + bytes + appendix_bytes; }
};

/// The header of the attributes of a block, which follow its payload.
struct PmAttributesHeader {
  std::uint32_t bytes = 0;  ///< of the payload
  std::uint32_t check = 0;
};

struct PmBlockHeader {
  std::uint32_t bytes = 0;  ///< of the payload
  std::uint32_t splits = 0;
  std::uint32_t check = 0;
};

/// Returns the CRC-32 of PNG and zlib. `before`: checksum of the preceding bytes, from which it
/// continues.
std::uint32_t pm_check(std::uint32_t before, std::span<const std::byte> bytes);

/// Returns the bytes of a header. Fills in its checksum and, for this payload of the base,
/// base_check.
std::array<std::byte, kPmHeaderBytes> pm_bytes(PmHeader& header, std::span<const std::byte> base);
/// Parses a header. Returns what is wrong, or an empty string. Pre: kPmHeaderBytes bytes.
std::string_view pm_parse(std::span<const std::byte> bytes, PmHeader& header);

/// Returns the bytes of a block's header. `check` covers its first 8 bytes and the payload.
std::array<std::byte, kPmBlockHeaderBytes> pm_bytes(const PmBlockHeader& header);
PmBlockHeader pm_parse_block(std::span<const std::byte> bytes);
/// Returns the checksum of a block with this payload, continued from `before`.
std::uint32_t pm_block_check(std::uint32_t before, std::uint32_t splits,
                             std::span<const std::byte> payload);

/// Returns the bytes of a header of attributes. `check` continues the checksum of what precedes,
/// and covers the other numbers of the header and what follows it.
std::array<std::byte, kPmBaseAttributesHeaderBytes> pm_bytes(const PmBaseAttributesHeader& header);
std::array<std::byte, kPmAttributesHeaderBytes> pm_bytes(const PmAttributesHeader& header);
PmBaseAttributesHeader pm_parse_base_attributes(std::span<const std::byte> bytes);
PmAttributesHeader pm_parse_attributes(std::span<const std::byte> bytes);

/// Maps floats to integers in the same order: adjacent floats differ by 1. -0 comes just below +0.
inline std::int32_t pm_ordered(float value) {
  const auto bits = std::bit_cast<std::int32_t>(value);
  return bits ^ ((bits >> 31) & 0x7FFFFFFF);
}
/// Returns whether the integer maps to a finite float.
inline bool is_finite_ordered(std::int64_t ordered) {
  return ordered >= -std::int64_t{0x7F800000} && ordered < std::int64_t{0x7F800000};
}
inline float pm_float(std::int32_t ordered) {
  return std::bit_cast<float>(ordered ^ ((ordered >> 31) & 0x7FFFFFFF));
}

}  // namespace mesher::progressive
