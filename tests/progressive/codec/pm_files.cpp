#include "tests/progressive/codec/pm_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "engine/core/error.h"
#include "engine/progressive/codec/pm_format.h"
#include "engine/progressive/codec/pm_read.h"
#include "engine/progressive/codec/pm_write.h"
#include "tests/progressive/checks.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

constexpr std::size_t kVersionAt = 8;

void put_u32(Bytes& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i)
    bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
}

std::uint32_t get_u32(const Bytes& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
  return value;
}

Mesh with_edges(Mesh mesh, float sharpness, std::uint32_t every) {
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); i += every)
    mesh.set_sharpness(mesh.edge(Halfedge(i)), sharpness);
  return mesh;
}

Mesh with_corners(Mesh mesh, float sharpness, std::uint32_t every) {
  for (std::uint32_t v = 0; v < mesh.vertex_count(); v += every)
    mesh.set_sharpness(Vertex(v), sharpness);
  return mesh;
}

Soup odd_floats() {
  Soup soup = torus(16, 9);
  for (std::size_t i = 0; i < soup.positions.size(); ++i) {
    glm::vec3& p = soup.positions[i];
    if (i % 5 == 0) p.x = -0.0F;
    if (i % 7 == 0) p.y = 1e-41F;
    if (i % 11 == 0) p.z = -3e38F;
    if (i % 13 == 0) p *= 1e-30F;
  }
  return soup;
}

Bytes written_with(progressive::ProgressiveMesh& mesh, const progressive::PmWriteOptions& options) {
  Bytes bytes;
  const progressive::PmSizes sizes =
      progressive::write_pm(mesh, options, [&](std::span<const std::byte> some) {
        bytes.insert(bytes.end(), some.begin(), some.end());
      });
  EXPECT_EQ(sizes.total, bytes.size());
  EXPECT_EQ(sizes.total, sizes.base + sizes.splits);
  return bytes;
}

}  // namespace

Bytes written(progressive::ProgressiveMesh& mesh, unsigned coordinate_bits) {
  return written_with(mesh, {.coordinate_bits = coordinate_bits});
}

Bytes written(progressive::ProgressiveMesh& mesh, progressive::ProgressiveAttributes& attributes,
              unsigned coordinate_bits, std::span<const std::byte> appendix) {
  return written_with(
      mesh, {.coordinate_bits = coordinate_bits, .attributes = &attributes, .appendix = appendix});
}

ReadBack read_back(std::span<const std::byte> bytes, std::size_t piece) {
  ReadBack result;
  progressive::PmReader reader("some.pm");
  try {
    if (piece == 0) piece = std::max<std::size_t>(bytes.size(), 1);
    for (std::size_t at = 0; at < bytes.size(); at += piece)
      reader.feed(bytes.subspan(at, std::min(piece, bytes.size() - at)));
    reader.finish();
  } catch (const InputError& error) {
    EXPECT_FALSE(reader.has_base());
    EXPECT_EQ(error.file(), "some.pm");
    EXPECT_EQ(0U, error.reason().find("byte ")) << error.reason();
    result.error = error.what();
    return result;
  }
  result.damage = reader.damage();
  result.is_complete = reader.is_complete();
  result.appendix.assign(reader.appendix().begin(), reader.appendix().end());
  result.attributes = reader.take_attributes();
  result.mesh = std::move(reader).take();
  return result;
}

void mend_checksums(Bytes& bytes) {
  if (bytes.size() < progressive::kPmHeaderBytes) return;
  const std::span<const std::byte> all = bytes;
  std::uint32_t check = progressive::pm_check(0, all.first(progressive::kPmHeaderBytes - 8));
  put_u32(bytes, progressive::kPmHeaderBytes - 8, check);
  const std::uint32_t base = get_u32(bytes, progressive::kPmHeaderBytes - 12);
  std::size_t at = progressive::kPmHeaderBytes;
  if (bytes.size() - at < base) return;
  check = progressive::pm_check(check, all.subspan(at, base));
  put_u32(bytes, progressive::kPmHeaderBytes - 4, check);
  at += base;
  const bool has_attributes = get_u32(bytes, kVersionAt) == progressive::kPmAttributeVersion;
  if (has_attributes) {
    constexpr std::size_t head = progressive::kPmBaseAttributesHeaderBytes;
    if (bytes.size() - at < head) return;
    const std::uint64_t size =
        progressive::pm_parse_base_attributes(all.subspan(at, head)).total_bytes();
    if (bytes.size() - at - head < size) return;
    check = progressive::pm_check(check, all.subspan(at, head - 4));
    check = progressive::pm_check(check, all.subspan(at + head, size));
    put_u32(bytes, at + head - 4, check);
    at += head + size;
  }
  while (bytes.size() - at >= progressive::kPmBlockHeaderBytes) {
    const std::uint32_t size = get_u32(bytes, at);
    const std::uint32_t splits = get_u32(bytes, at + 4);
    if (bytes.size() - at - progressive::kPmBlockHeaderBytes < size) return;
    check = progressive::pm_block_check(check, splits,
                                        all.subspan(at + progressive::kPmBlockHeaderBytes, size));
    put_u32(bytes, at + 8, check);
    at += progressive::kPmBlockHeaderBytes + size;
    if (!has_attributes) continue;
    constexpr std::size_t head = progressive::kPmAttributesHeaderBytes;
    if (bytes.size() - at < head) return;
    const std::uint32_t attributes = get_u32(bytes, at);
    if (bytes.size() - at - head < attributes) return;
    check = progressive::pm_check(check, all.subspan(at, head - 4));
    check = progressive::pm_check(check, all.subspan(at + head, attributes));
    put_u32(bytes, at + head - 4, check);
    at += head + attributes;
  }
}

void expect_sound(ReadBack& read) {
  if (!read.error.empty()) return;
  EXPECT_TRUE(read.is_complete || !read.damage.empty());
  const bool has_attributes = !read.attributes.is_empty();
  if (has_attributes) {
    ASSERT_EQ(read.attributes.split_count(), read.mesh.split_count());
  }
  const std::uint32_t full = read.mesh.split_count();
  for (const std::uint32_t level : {full, full / 2, 0U}) {
    read.mesh.go_to(level);
    expect_valid(read.mesh.mesh());
    if (!has_attributes) continue;
    read.attributes.go_to(level);
    expect_valid_level(read.mesh, read.attributes);
  }
}

void expect_same_attributes(const progressive::ProgressiveMesh& mesh,
                            progressive::ProgressiveAttributes& a,
                            progressive::ProgressiveAttributes& b) {
  const auto is_same_prefix = [](const auto& x, const auto& y, std::size_t count) {
    ASSERT_GE(x.size(), count);
    ASSERT_GE(y.size(), count);
    ASSERT_TRUE(std::equal(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(count), y.begin()));
  };
  ASSERT_EQ(a.layers().size(), b.layers().size());
  ASSERT_EQ(a.groups(), b.groups());
  ASSERT_EQ(a.group().empty(), b.group().empty());
  constexpr std::uint64_t kLevels = 12;
  for (std::uint64_t k = 0; k <= kLevels; ++k) {
    const auto level = static_cast<std::uint32_t>(b.split_count() * k / kLevels);
    SCOPED_TRACE("level " + std::to_string(level));
    a.go_to(level);
    b.go_to(level);
    ASSERT_EQ(a.wedge_count(level), b.wedge_count(level));
    const std::size_t faces = mesh.face_count(level);
    if (!a.has_no_layers()) is_same_prefix(a.corner_wedges(), b.corner_wedges(), 3 * faces);
    if (!a.group().empty()) is_same_prefix(a.group(), b.group(), faces);
    for (std::size_t l = 0; l < a.layers().size(); ++l) {
      const AttributeType& type = a.layers()[l].type();
      ASSERT_EQ(type, b.layers()[l].type());
      is_same_prefix(a.layers()[l].bytes(), b.layers()[l].bytes(),
                     a.wedge_count(level) * type.value_bytes());
    }
  }
}

std::vector<NamedMesh> meshes_of_all_kinds() {
  const Mesh ring = built(torus(20, 12)).mesh;
  const Mesh sheet = built(grid(12)).mesh;
  Soup lonely = grid(6);
  lonely.positions.push_back({1, 2, 3});
  std::vector<NamedMesh> all;
  all.push_back({"torus", ring});
  all.push_back({"sheet", sheet});
  all.push_back({"creases", with_edges(ring, kInfinitelySharp, 5)});
  all.push_back({"semi-sharp", with_edges(with_edges(sheet, 2.5F, 3), 1.0F, 10)});
  all.push_back({"corners", with_corners(ring, 3.0F, 4)});
  all.push_back({"both", with_corners(with_edges(sheet, kInfinitelySharp, 9), 1.5F, 6)});
  all.push_back(
      {"parts", built(join(join(torus(9, 7), grid(5), {9, 0, 0}), cube(), {0, 9, 0})).mesh});
  all.push_back({"isolated", built(std::move(lonely), {.keep_isolated_vertices = true}).mesh});
  all.push_back({"odd floats", built(odd_floats()).mesh});
  all.push_back({"cut", built(moebius(24)).mesh});
  all.push_back({"one face", built(soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2})).mesh});
  all.push_back({"nothing", Mesh()});
  for (std::uint32_t seed = 0; seed < 20; ++seed)
    all.push_back({"random " + std::to_string(seed), built(random_soup(seed)).mesh});
  return all;
}

}  // namespace mesher::test
