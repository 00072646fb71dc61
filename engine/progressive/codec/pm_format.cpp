#include "engine/progressive/codec/pm_format.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/mesh/ids.h"

namespace mesher::progressive {
namespace {

/// Writes little-endian numbers one after another.
class Put {
 public:
  explicit Put(std::byte* to) : to_(to) {}
  void u32(std::uint32_t value) { put(value, 4); }
  void f64(double value) { put(std::bit_cast<std::uint64_t>(value), 8); }

 private:
  void put(std::uint64_t value, unsigned bytes) {
    for (unsigned i = 0; i < bytes; ++i)
      *to_++ = static_cast<std::byte>(value >> (8 * i));
  }
  std::byte* to_;
};

class Take {
 public:
  explicit Take(const std::byte* from) : from_(from) {}
  std::uint32_t u32() { return static_cast<std::uint32_t>(take(4)); }
  double f64() { return std::bit_cast<double>(take(8)); }

 private:
  std::uint64_t take(unsigned bytes) {
    std::uint64_t value = 0;
    for (unsigned i = 0; i < bytes; ++i)
      value |= std::to_integer<std::uint64_t>(*from_++) << (8 * i);
    return value;
  }
  const std::byte* from_;
};

bool is_usable(const PmGrid& grid, std::uint32_t bits) {
  const double side = grid.step * static_cast<double>((std::uint32_t{1} << bits) - 1);
  if (!(grid.step > 0.0)) return false;
  return std::all_of(grid.origin.begin(), grid.origin.end(), [&](double origin) {
    // Values that round to the largest float are usable, too.
    constexpr double most = std::numeric_limits<float>::max() * (1.0 + 1e-9);
    return std::abs(origin) <= most && std::abs(origin + side) <= most;
  });
}

std::string_view objection(const PmHeader& header, std::uint32_t version) {
  constexpr std::uint32_t most_faces = kNone / 3 - 2;
  const std::uint32_t needed = version == kPmVersion ? 0 : kPmAttributes;
  if ((header.flags & ~(kPmSharpEdges | kPmSharpVertices)) != needed) {
    return "the header has flags that this version of the format does not know";
  }
  const std::uint32_t bits = header.coordinate_bits;
  if (bits != 0 && (bits < kPmLeastCoordinateBits || bits > kPmMostCoordinateBits)) {
    return "coordinates have neither 0 nor 4 to 24 bits";
  }
  if (bits != 0 && !is_usable(header.grid, bits)) {
    return "the grid of the coordinates is not finite";
  }
  if (header.base_faces > most_faces || header.base_vertices >= kNone - header.splits) {
    return "more vertices or faces than ids";
  }
  const std::uint32_t elements = std::max(header.base_vertices, header.base_faces);
  if (header.base_bytes < pm_least_base_bytes(elements)) {
    return "the base has more vertices or faces than its bytes can hold";
  }
  return {};
}

}  // namespace

glm::ivec3 PmGrid::numbers(const glm::vec3& position, unsigned bits) const {
  const double highest = (std::uint32_t{1} << bits) - 1;
  glm::ivec3 result;
  for (int i = 0; i < 3; ++i) {
    const double number = std::floor((double{position[i]} - origin[i]) / step + 0.5);
    result[i] = static_cast<int>(std::clamp(number, 0.0, highest));
  }
  return result;
}

glm::vec3 PmGrid::nearest(const glm::vec3& position, unsigned bits) const {
  return this->position(numbers(position, bits));
}

std::uint32_t pm_check(std::uint32_t before, std::span<const std::byte> bytes) {
  if (bytes.empty()) return before;  // zlib takes a null pointer for a new beginning
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::array<std::byte, kPmHeaderBytes> pm_bytes(PmHeader& header, std::span<const std::byte> base) {
  header.base_bytes = static_cast<std::uint32_t>(base.size());
  std::array<std::byte, kPmHeaderBytes> bytes{};
  std::memcpy(bytes.data(), kPmMagic.data(), kPmMagic.size());
  Put put(bytes.data() + kPmMagic.size());
  put.u32(header.has_attributes() ? kPmAttributeVersion : kPmVersion);
  put.u32(header.flags);
  put.u32(header.coordinate_bits);
  put.u32(header.base_vertices);
  put.u32(header.base_faces);
  put.u32(header.splits);
  for (const double x : header.grid.origin)
    put.f64(x);
  put.f64(header.grid.step);
  put.u32(header.base_bytes);
  header.check = pm_check(0, std::span(bytes).first(kPmHeaderBytes - 8));
  header.base_check = pm_check(header.check, base);
  put.u32(header.check);
  put.u32(header.base_check);
  return bytes;
}

std::string_view pm_parse(std::span<const std::byte> bytes, PmHeader& header) {
  if (std::memcmp(bytes.data(), kPmMagic.data(), kPmMagic.size()) != 0) {
    return "not a progressive mesh, or one that was damaged as text";
  }
  Take take(bytes.data() + kPmMagic.size());
  const std::uint32_t version = take.u32();
  if (version != kPmVersion && version != kPmAttributeVersion) {
    return "the file is of another version of the format";
  }
  header.flags = take.u32();
  header.coordinate_bits = take.u32();
  header.base_vertices = take.u32();
  header.base_faces = take.u32();
  header.splits = take.u32();
  for (double& x : header.grid.origin)
    x = take.f64();
  header.grid.step = take.f64();
  header.base_bytes = take.u32();
  header.check = take.u32();
  if (header.check != pm_check(0, bytes.first(kPmHeaderBytes - 8))) {
    return "the checksum of the header is wrong";
  }
  header.base_check = take.u32();
  return objection(header, version);
}

std::array<std::byte, kPmBlockHeaderBytes> pm_bytes(const PmBlockHeader& header) {
  std::array<std::byte, kPmBlockHeaderBytes> bytes{};
  Put put(bytes.data());
  put.u32(header.bytes);
  put.u32(header.splits);
  put.u32(header.check);
  return bytes;
}

PmBlockHeader pm_parse_block(std::span<const std::byte> bytes) {
  Take take(bytes.data());
  PmBlockHeader header;
  header.bytes = take.u32();
  header.splits = take.u32();
  header.check = take.u32();
  return header;
}

std::uint32_t pm_block_check(std::uint32_t before, std::uint32_t splits,
                             std::span<const std::byte> payload) {
  const auto header =
      pm_bytes(PmBlockHeader{static_cast<std::uint32_t>(payload.size()), splits, 0});
  return pm_check(pm_check(before, std::span(header).first(8)), payload);
}

std::array<std::byte, kPmBaseAttributesHeaderBytes> pm_bytes(const PmBaseAttributesHeader& header) {
  std::array<std::byte, kPmBaseAttributesHeaderBytes> bytes{};
  Put put(bytes.data());
  put.u32(header.table_bytes);
  put.u32(header.bytes);
  put.u32(header.appendix_bytes);
  put.u32(header.check);
  return bytes;
}

std::array<std::byte, kPmAttributesHeaderBytes> pm_bytes(const PmAttributesHeader& header) {
  std::array<std::byte, kPmAttributesHeaderBytes> bytes{};
  Put put(bytes.data());
  put.u32(header.bytes);
  put.u32(header.check);
  return bytes;
}

PmBaseAttributesHeader pm_parse_base_attributes(std::span<const std::byte> bytes) {
  Take take(bytes.data());
  PmBaseAttributesHeader header;
  header.table_bytes = take.u32();
  header.bytes = take.u32();
  header.appendix_bytes = take.u32();
  header.check = take.u32();
  return header;
}

PmAttributesHeader pm_parse_attributes(std::span<const std::byte> bytes) {
  Take take(bytes.data());
  PmAttributesHeader header;
  header.bytes = take.u32();
  header.check = take.u32();
  return header;
}

}  // namespace mesher::progressive
