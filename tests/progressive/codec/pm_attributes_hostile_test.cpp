// Truncated, damaged and malicious files of progressive meshes with attributes.
#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <random>
#include <string>

#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/progressive/build.h"
#include "engine/progressive/codec/pm_format.h"
#include "engine/progressive/codec/pm_read.h"
#include "engine/progressive/codec/pm_write.h"
#include "tests/progressive/charts.h"
#include "tests/progressive/checks.h"
#include "tests/progressive/codec/pm_files.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

namespace mesher::test {
namespace {

/// A small progressive mesh with seams, groups and colors, and at least three blocks.
progressive::Progressive attributed_sample() {
  const Mesh mesh = built(join(torus(14, 9), grid(5), {6, 0, 0})).mesh;
  Attributes attributes = charted(mesh, [](std::uint32_t f) { return f / 60; });
  AttributeLayer color(color_type(), mesh.halfedge_count());
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const auto v = static_cast<std::uint8_t>(mesh.origin(Halfedge(h)).index());
    color.values<glm::u8vec4>()[h] = {v, 255 - v, h / 3 % 50 == 0 ? 9 : 0, 255};
  }
  std::vector<AttributeLayer> layers;
  layers.push_back(std::move(color));
  set_corner_layers(mesh, attributes, std::move(layers));
  attributes.groups = named_groups({"a", "b"});
  attributes.group.resize(mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    attributes.group[f] = f < 90 ? 0 : 1;
  return progressive::make_progressive(mesh, attributes, {.target_faces = 24});
}

Bytes sample_bytes(progressive::Progressive& made, unsigned bits) {
  const std::string text = "appendix";
  return written(made.mesh, made.attributes, bits, std::as_bytes(std::span(text)));
}

/// Fails unless what was read equals the sample at some level.
void expect_attributed_prefix(ReadBack& whole, ReadBack& part) {
  part.mesh.go_to(part.mesh.split_count());
  whole.mesh.go_to(part.mesh.split_count());
  ASSERT_TRUE(is_identical(whole.mesh.mesh(), part.mesh.mesh()));
  ASSERT_EQ(part.attributes.split_count(), part.mesh.split_count());
  expect_same_attributes(part.mesh, whole.attributes, part.attributes);
}

TEST(PmAttributesHostile, TruncationAtAnyLengthIsDetected) {
  progressive::Progressive made = attributed_sample();
  const Bytes bytes = sample_bytes(made, 0);
  ReadBack whole = read_back(bytes);
  ASSERT_TRUE(whole.is_complete);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    SCOPED_TRACE(length);
    ReadBack read = read_back(std::span(bytes).first(length));
    EXPECT_FALSE(read.is_complete && read.damage.empty());
    EXPECT_NE(read.error.empty(), read.damage.empty());
    if (read.error.empty()) expect_attributed_prefix(whole, read);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(PmAttributesHostile, EveryFlippedByteIsDetected) {
  progressive::Progressive made = attributed_sample();
  const Bytes bytes = sample_bytes(made, 10);
  ReadBack whole = read_back(bytes);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int change : {1, 0x80, 0xFF}) {
      SCOPED_TRACE(std::to_string(i) + " ^ " + std::to_string(change));
      Bytes damaged = bytes;
      damaged[i] ^= static_cast<std::byte>(change);
      ReadBack read = read_back(damaged);
      EXPECT_NE(read.error.empty(), read.damage.empty());
      if (read.error.empty()) expect_attributed_prefix(whole, read);
      if (testing::Test::HasFailure()) return;
    }
  }
}

/// Flips bytes and corrects the checksums, so that the decoder sees the changed content.
void flip_bytes_of_attributes(unsigned coordinate_bits) {
  progressive::Progressive made = attributed_sample();
  const Bytes bytes = sample_bytes(made, coordinate_bits);
  // Exact files have twice the bytes, so each is changed once.
  const bool is_slow = kSanitized || coordinate_bits == 0;
  const std::vector<int> changes = is_slow ? std::vector{0x40} : std::vector{1, 0x40, 0xFF};
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

TEST(PmAttributesHostile, FlippedBytesOfExactFileWithValidChecksumsAreSafe) {
  flip_bytes_of_attributes(0);
}

TEST(PmAttributesHostile, FlippedBytesOfRoundedFileWithValidChecksumsAreSafe) {
  flip_bytes_of_attributes(10);
}

TEST(PmAttributesHostile, NoiseWithValidChecksumsIsSafe) {
  progressive::Progressive made = attributed_sample();
  const Bytes original[] = {sample_bytes(made, 0), sample_bytes(made, 12)};
  for (std::uint32_t seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Bytes bytes = original[seed % 2];
    const std::size_t from =
        progressive::kPmHeaderBytes + random() % (bytes.size() - progressive::kPmHeaderBytes);
    const auto run = static_cast<std::byte>(random());
    for (std::size_t i = from; i < bytes.size(); ++i) {
      if (random() % 40 == 0) bytes[i] = seed % 3 == 0 ? run : static_cast<std::byte>(random());
    }
    mend_checksums(bytes);
    ReadBack read = read_back(bytes);
    expect_sound(read);
    if (testing::Test::HasFailure()) return;
  }
}

/// Writes a number into a file and corrects the checksums.
Bytes with_number(Bytes bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i)
    bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
  mend_checksums(bytes);
  return bytes;
}

std::uint32_t number_at(const Bytes& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
  return value;
}

TEST(PmAttributesHostile, HugeCountsAllocateNoMemory) {
  progressive::Progressive made = attributed_sample();
  const Bytes bytes = sample_bytes(made, 0);
  const std::size_t head =
      progressive::kPmHeaderBytes + number_at(bytes, progressive::kPmHeaderBytes - 12);
  const std::size_t base =
      progressive::write_pm(made.mesh, {.attributes = &made.attributes}, [](auto) {}).base +
      std::size_t{8};  // the appendix
  const std::size_t of_block = base + progressive::kPmBlockHeaderBytes + number_at(bytes, base);
  const MemoryLimit limit(std::uint64_t{64} << 20U);
  for (const std::uint32_t count : {100'000U, 0x3FFFFFFFU, 0xFFFFFFF0U}) {
    for (const std::size_t at : {head, head + 4, head + 8})
      EXPECT_NE(read_back(with_number(bytes, at, count)).error, "");
    ReadBack block = read_back(with_number(bytes, of_block, count));
    EXPECT_EQ(block.error, "");
    EXPECT_EQ(block.mesh.split_count(), 0U);
    EXPECT_NE(block.damage, "");
  }
}

// Zeros may stand for any number of splits with the most probable attributes.
TEST(PmAttributesHostile, ValuesTakeMemoryInProportionToTheirBytes) {
  const Mesh mesh = built(grid(40)).mesh;
  Attributes attributes;
  std::vector<AttributeLayer> layers;
  for (std::uint32_t k = 0; k < 60; ++k) {
    AttributeType type = color_type(k);
    type.component = ComponentType::f32;
    layers.emplace_back(type, mesh.halfedge_count());
    std::ranges::fill(layers.back().bytes(), std::byte{0});
  }
  set_corner_layers(mesh, attributes, std::move(layers));
  progressive::Progressive made =
      progressive::make_progressive(mesh, attributes, {.target_faces = 100});
  const Bytes bytes = written(made.mesh, made.attributes);
  const std::uint64_t values = made.attributes.wedge_count(made.attributes.split_count()) *
                               std::uint64_t{60} * sizeof(glm::vec4);
  EXPECT_GT(128 * bytes.size() + 65'536, values);
  // A payload of the attributes that is too short for them is refused.
  const std::size_t base =
      progressive::write_pm(made.mesh, {.attributes = &made.attributes}, [](auto) {}).base;
  std::size_t at = 0;  // of the last block's attributes, whose models have adapted
  for (std::size_t block = base; block < bytes.size();) {
    at = block + progressive::kPmBlockHeaderBytes + number_at(bytes, block);
    block = at + progressive::kPmAttributesHeaderBytes + number_at(bytes, at);
  }
  // Zeros at its end change nothing but its size.
  const std::uint32_t half = number_at(bytes, at) / 2;
  const auto end = static_cast<std::ptrdiff_t>(at + progressive::kPmAttributesHeaderBytes + half);
  const Bytes cut(bytes.begin(), bytes.begin() + end);
  ReadBack read = read_back(with_number(cut, at, half));
  EXPECT_EQ(read.error, "");
  EXPECT_NE(read.damage.find("more values"), std::string::npos) << read.damage;
  EXPECT_GT(read.mesh.split_count(), 1000U);
  EXPECT_FALSE(read.is_complete);
  expect_sound(read);
}

TEST(PmAttributesHostile, OutOfMemoryKeepsWhatWasReadSoFar) {
  const Mesh mesh = built(torus(80, 60)).mesh;
  progressive::Progressive made = progressive::make_progressive(
      mesh, charted(mesh, [](std::uint32_t f) { return f / 800; }), {.target_faces = 60});
  const Bytes bytes = written(made.mesh, made.attributes);
  for (std::uint64_t kilobytes = 20; kilobytes < 400; kilobytes += 20) {
    progressive::PmReader reader("x.pm");
    reader.feed(std::span(bytes).first(40'000));
    const std::uint32_t before = reader.mesh().split_count();
    ASSERT_GT(before, 64U);
    {
      const MemoryLimit limit(kilobytes << 10U);
      EXPECT_THROW(reader.feed(std::span(bytes).subspan(40'000)), std::bad_alloc);
    }
    EXPECT_GE(reader.mesh().split_count(), before);
    EXPECT_EQ(reader.attributes().split_count(), reader.mesh().split_count());
    expect_valid_level(reader.mesh(), reader.attributes());
    ASSERT_FALSE(HasFailure()) << kilobytes;
  }
}

}  // namespace
}  // namespace mesher::test
