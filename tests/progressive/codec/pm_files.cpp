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

}  // namespace

Bytes written(progressive::ProgressiveMesh& mesh, unsigned coordinate_bits) {
  Bytes bytes;
  const progressive::PmSizes sizes = progressive::write_pm(
      mesh, {.coordinate_bits = coordinate_bits}, [&](std::span<const std::byte> some) {
        bytes.insert(bytes.end(), some.begin(), some.end());
      });
  EXPECT_EQ(sizes.total, bytes.size());
  EXPECT_EQ(sizes.total, sizes.base + sizes.splits);
  return bytes;
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
  while (bytes.size() - at >= progressive::kPmBlockHeaderBytes) {
    const std::uint32_t size = get_u32(bytes, at);
    const std::uint32_t splits = get_u32(bytes, at + 4);
    if (bytes.size() - at - progressive::kPmBlockHeaderBytes < size) return;
    check = progressive::pm_block_check(check, splits,
                                        all.subspan(at + progressive::kPmBlockHeaderBytes, size));
    put_u32(bytes, at + 8, check);
    at += progressive::kPmBlockHeaderBytes + size;
  }
}

void expect_sound(ReadBack& read) {
  if (!read.error.empty()) return;
  EXPECT_TRUE(read.is_complete || !read.damage.empty());
  expect_valid(read.mesh.mesh());
  read.mesh.go_to(read.mesh.split_count() / 2);
  expect_valid(read.mesh.mesh());
  read.mesh.go_to(0);
  expect_valid(read.mesh.mesh());
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
