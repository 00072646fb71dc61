// Truncated, damaged and malicious files of progressive meshes.
#include <gtest/gtest.h>

#include <new>
#include <random>
#include <string>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/progressive/build.h"
#include "engine/progressive/codec/pm_format.h"
#include "engine/progressive/codec/pm_read.h"
#include "engine/progressive/codec/pm_write.h"
#include "tests/progressive/checks.h"
#include "tests/progressive/codec/pm_files.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

namespace mesher::test {
namespace {

/// A small progressive mesh with every kind of sharpness and at least three blocks.
progressive::ProgressiveMesh sample() {
  Mesh mesh = built(join(torus(20, 12), grid(5), {6, 0, 0})).mesh;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); i += 11)
    mesh.set_sharpness(mesh.edge(Halfedge(i)), i % 2 == 0 ? kInfinitelySharp : 1.25F);
  mesh.set_sharpness(Vertex(3), 2.0F);
  return progressive::make_progressive(mesh, {.target_faces = 30}).mesh;
}

/// Size of header and base in bytes.
std::size_t written_base_bytes(progressive::ProgressiveMesh& mesh) {
  return progressive::write_pm(mesh, {}, [](auto) {}).base;
}

/// Fails unless the mesh that was read equals the sample at some level.
void expect_prefix(progressive::ProgressiveMesh& whole, progressive::ProgressiveMesh& part) {
  part.go_to(part.split_count());
  whole.go_to(part.split_count());
  EXPECT_TRUE(is_identical(whole.mesh(), part.mesh()));
}

TEST(PmHostile, TruncationAtAnyLengthIsDetected) {
  progressive::ProgressiveMesh mesh = sample();
  for (const unsigned bits : {0U, 14U}) {
    const Bytes bytes = written(mesh, bits);
    progressive::ProgressiveMesh whole = read_back(bytes).mesh;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      SCOPED_TRACE(length);
      ReadBack read = read_back(std::span(bytes).first(length));
      EXPECT_FALSE(read.is_complete);
      EXPECT_NE(read.error.empty(), read.damage.empty());
      if (read.error.empty()) expect_prefix(whole, read.mesh);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(PmHostile, EveryFlippedByteIsDetected) {
  progressive::ProgressiveMesh mesh = sample();
  const Bytes bytes = written(mesh, 10);
  progressive::ProgressiveMesh whole = read_back(bytes).mesh;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int change : {1, 0x80, 0xFF}) {
      SCOPED_TRACE(std::to_string(i) + " ^ " + std::to_string(change));
      Bytes damaged = bytes;
      damaged[i] ^= static_cast<std::byte>(change);
      ReadBack read = read_back(damaged);
      EXPECT_NE(read.error.empty(), read.damage.empty());
      if (read.error.empty()) expect_prefix(whole, read.mesh);
      ReadBack slowly = read_back(damaged, 1);
      EXPECT_EQ(read.error, slowly.error);
      EXPECT_EQ(read.damage, slowly.damage);
      if (testing::Test::HasFailure()) return;
    }
  }
}

/// Flips bytes and corrects the checksums, so that the decoder sees the changed content.
void flip_every_byte_under_right_checksums(unsigned coordinate_bits) {
  progressive::ProgressiveMesh mesh = sample();
  const Bytes bytes = written(mesh, coordinate_bits);
  const std::vector<int> changes = kSanitized ? std::vector{0x40} : std::vector{1, 0x40, 0xFF};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int change : changes) {
      SCOPED_TRACE(std::to_string(i) + " ^ " + std::to_string(change));
      Bytes damaged = bytes;
      damaged[i] ^= static_cast<std::byte>(change);
      mend_checksums(damaged);
      ReadBack read = read_back(damaged);
      expect_sound(read);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(PmHostile, FlippedBytesOfExactFileWithValidChecksumsAreSafe) {
  flip_every_byte_under_right_checksums(0);
}

TEST(PmHostile, FlippedBytesOfGridFileWithValidChecksumsAreSafe) {
  flip_every_byte_under_right_checksums(10);
}

TEST(PmHostile, NoiseWithValidChecksumsIsSafe) {
  progressive::ProgressiveMesh mesh = sample();
  for (std::uint32_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Bytes bytes = written(mesh, seed % 2 == 0 ? 0 : 12);
    // From some position on, payloads are noise. Some files have long runs of one byte.
    const std::size_t from =
        progressive::kPmHeaderBytes + random() % (bytes.size() - progressive::kPmHeaderBytes);
    const auto run = static_cast<std::byte>(random());
    for (std::size_t i = from; i < bytes.size(); ++i) {
      if (random() % 8 == 0) bytes[i] = seed % 3 == 0 ? run : static_cast<std::byte>(random());
    }
    mend_checksums(bytes);
    ReadBack read = read_back(bytes);
    expect_sound(read);
    if (testing::Test::HasFailure()) return;
  }
}

/// Writes a number into a file and corrects the checksums.
Bytes with_u32(Bytes bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i)
    bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
  mend_checksums(bytes);
  return bytes;
}

TEST(PmHostile, HugeCountsAllocateNoMemory) {
  progressive::ProgressiveMesh mesh = sample();
  const Bytes bytes = written(mesh);
  const std::size_t first_block = written_base_bytes(mesh);
  const MemoryLimit limit(std::uint64_t{64} << 20U);
  constexpr std::size_t vertices = 20;
  constexpr std::size_t faces = 24;
  constexpr std::size_t splits = 28;
  for (const std::uint32_t count : {100'000U, 0x3FFFFFFFU, 0xFFFFFFF0U}) {
    EXPECT_NE(read_back(with_u32(bytes, vertices, count)).error, "");
    EXPECT_NE(read_back(with_u32(bytes, faces, count)).error, "");
    ReadBack block = read_back(with_u32(bytes, first_block + 4, count));
    EXPECT_EQ(block.mesh.split_count(), 0U);
    EXPECT_NE(block.damage, "");
    ReadBack size = read_back(with_u32(bytes, first_block, count));
    EXPECT_NE(size.damage, "");
  }
  ReadBack many = read_back(with_u32(bytes, splits, 0xFFFFFF00U));
  EXPECT_EQ(many.error, "");
  EXPECT_EQ(many.mesh.split_count(), mesh.split_count());
  EXPECT_NE(many.damage.find("of 4,294,967,040 splits"), std::string::npos) << many.damage;
}

TEST(PmHostile, OutOfMemoryKeepsTheMeshReadSoFar) {
  progressive::ProgressiveMesh mesh =
      progressive::make_progressive(built(torus(80, 60)).mesh, {.target_faces = 60}).mesh;
  const Bytes bytes = written(mesh);
  progressive::PmReader reader("x.pm");
  reader.feed(std::span(bytes).first(20'000));
  const std::uint32_t before = reader.mesh().split_count();
  ASSERT_GT(before, 64U);
  {
    const MemoryLimit limit(std::uint64_t{100} << 10U);
    EXPECT_THROW(reader.feed(std::span(bytes).subspan(20'000)), std::bad_alloc);
  }
  EXPECT_GE(reader.mesh().split_count(), before);
  EXPECT_FALSE(reader.is_complete());
  EXPECT_NE(reader.damage(), "");
  expect_valid_level(reader.mesh());
  mesh.go_to(reader.mesh().split_count());
  EXPECT_TRUE(is_identical(mesh.mesh(), reader.mesh().mesh()));
}

TEST(PmHostile, RejectsOtherVersionsAndFlags) {
  progressive::ProgressiveMesh mesh = sample();
  const Bytes bytes = written(mesh);
  for (const auto& [at, value] : {std::pair{8U, 2U},
                                  {12U, 4U},
                                  {12U, 0x80000000U},
                                  {16U, 3U},
                                  {16U, 25U},
                                  {16U, 14U},
                                  {64U, 0U},
                                  {64U, 1U}}) {
    EXPECT_NE(read_back(with_u32(bytes, at, value)).error, "") << at << " " << value;
  }
}

TEST(PmHostile, RejectsARepeatedBlock) {
  progressive::ProgressiveMesh mesh = sample();
  const Bytes bytes = written(mesh);
  const std::size_t base = written_base_bytes(mesh);
  std::size_t end = base + progressive::kPmBlockHeaderBytes;
  for (std::size_t i = 0; i < 4; ++i)
    end += std::to_integer<std::size_t>(bytes[base + i]) << (8 * i);
  Bytes twice(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(end));
  twice.insert(twice.end(), bytes.begin() + static_cast<std::ptrdiff_t>(base), bytes.end());
  ReadBack read = read_back(twice);
  EXPECT_EQ(read.mesh.split_count(), 64U);
  EXPECT_NE(read.damage.find("checksum"), std::string::npos) << read.damage;
}

TEST(PmHostile, ReportsBytesAfterTheEnd) {
  progressive::ProgressiveMesh mesh = sample();
  Bytes bytes = written(mesh);
  bytes.push_back(std::byte{7});
  ReadBack read = read_back(bytes);
  EXPECT_TRUE(read.is_complete);
  EXPECT_NE(read.damage.find("follow"), std::string::npos) << read.damage;
  ReadBack slowly = read_back(bytes, 1);
  EXPECT_EQ(read.damage, slowly.damage);
  expect_same(read.mesh, slowly.mesh);
}

TEST(PmHostile, DamageMessageHasPositionAndAmount) {
  progressive::ProgressiveMesh mesh = sample();
  Bytes bytes = written(mesh);
  bytes[bytes.size() - 1] ^= std::byte{1};
  progressive::PmReader reader("x.pm");
  reader.feed(bytes);
  EXPECT_TRUE(reader.has_base());
  const std::string damage(reader.damage());
  const std::string end = std::to_string(reader.mesh().split_count()) + " of " +
                          std::to_string(mesh.split_count()) + " splits were read";
  EXPECT_EQ(damage.find("byte "), 0U);
  EXPECT_TRUE(damage.ends_with(end)) << damage;
  const std::uint32_t before = reader.mesh().split_count();
  reader.feed(bytes);
  reader.finish();
  EXPECT_EQ(reader.mesh().split_count(), before);
  EXPECT_EQ(reader.damage(), damage);
}

TEST(PmHostile, RejectsOtherFilesAtTheirFirstBytes) {
  for (const std::string text : {"PM\n", "solid x", "\x89PNG\r\n\x1a\n", "\x89MPM\n\x1a\n      "}) {
    progressive::PmReader reader("x.pm");
    EXPECT_THROW(reader.feed(std::as_bytes(std::span(text))), InputError) << text;
    EXPECT_FALSE(progressive::PmReader::is_pm(std::as_bytes(std::span(text))));
  }
  progressive::PmReader nothing("x.pm");
  nothing.feed({});
  EXPECT_THROW(nothing.finish(), InputError);
}

}  // namespace
}  // namespace mesher::test
