// How much memory crafted files of progressive meshes take, by our own account.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <span>
#include <string>

#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/progressive/codec/pm_format.h"
#include "engine/progressive/codec/pm_read.h"
#include "tests/progressive/codec/pm_files.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

constexpr std::uint64_t kPlenty = std::uint64_t{4} << 30U;
/// What models, blocks and the base take, whatever the number of splits.
constexpr std::uint64_t kConstant = std::uint64_t{6} << 20U;

/// A double cone of `sides` sides: both tips have that many faces.
Soup double_cone(std::uint32_t sides) {
  Soup soup = soup_of({{0, 0, 1}, {0, 0, -1}}, {});
  for (std::uint32_t i = 0; i < sides; ++i) {
    soup.positions.emplace_back(float(i), float(i * i % 7), 0.0F);
    const std::uint32_t a = 2 + i;
    const std::uint32_t b = 2 + (i + 1) % sides;
    for (const std::uint32_t v : {0U, a, b, 1U, b, a})
      soup.corners.push_back(v);
  }
  return soup;
}

/// Splits each new vertex again, and gives its child as many corners as a file may hold.
progressive::ProgressiveMesh greedy(std::uint32_t splits) {
  constexpr std::uint32_t kMoved = 15;
  progressive::ProgressiveMesh mesh(Mesh(built(double_cone(kMoved + 2)).mesh));
  Vertex parent(0);
  for (std::uint32_t i = 0; i < splits; ++i) {
    progressive::NewSplit split{.parent = parent,
                                .cut = {.left = 0, .right = kMoved},
                                .parent_position = glm::vec3(0, 0, 1),
                                .child_position = glm::vec3(0, 0, 1)};
    mesh.append(split);
    parent = mesh.child(i);
  }
  return mesh;
}

struct Taken {
  std::string error;
  std::uint32_t splits = 0;
  std::uint64_t peak = 0;  ///< bytes
};

/// Reads a whole file as engine/io/pm_file.h does.
Taken read_counted(const Bytes& bytes) {
  Taken taken;
  const MemoryLimit limit(kPlenty);
  try {
    progressive::PmReader reader("x.pm");
    const std::span<const std::byte> all(bytes);
    reader.expect_splits(progressive::PmReader::count_splits(all));
    constexpr std::size_t kPiece = std::size_t{1} << 16U;
    for (std::size_t at = 0; at < bytes.size(); at += kPiece)
      reader.feed(all.subspan(at, std::min(kPiece, bytes.size() - at)));
    reader.finish();
    taken.splits = reader.mesh().split_count();
  } catch (const InputError& error) {
    taken.error = error.reason();
  }
  taken.peak = MemoryLimit::peak();
  return taken;
}

TEST(PmMemory, SplitTakesAtMost256Bytes) {
  constexpr std::uint32_t kSplits = 150'000;
  progressive::ProgressiveMesh mesh = greedy(kSplits);
  for (const unsigned bits : {0U, 12U}) {
    const Bytes bytes = written(mesh, bits);
    const Taken taken = read_counted(bytes);
    EXPECT_EQ(taken.error, "");
    EXPECT_EQ(taken.splits, kSplits);
    EXPECT_LE(taken.peak, 256U * kSplits + kConstant) << bits << " bits";
  }
}

// The rest of the file is missing, and with it most of the announced splits.
TEST(PmMemory, OnlySplitsThatTheFileHoldsTakeMemory) {
  constexpr std::uint32_t kSplits = 150'000;
  progressive::ProgressiveMesh mesh = greedy(kSplits);
  Bytes bytes = written(mesh);
  bytes.resize(bytes.size() / 3);
  const Taken taken = read_counted(bytes);
  EXPECT_GT(taken.splits, kSplits / 5);
  EXPECT_LT(taken.splits, kSplits / 2);
  EXPECT_LE(taken.peak, 256U * taken.splits + kConstant);
}

TEST(PmMemory, CountSplitsBelievesBlocksAndNotTheHeader) {
  progressive::ProgressiveMesh mesh = greedy(5000);
  Bytes bytes = written(mesh);
  EXPECT_EQ(progressive::PmReader::count_splits(bytes), 5000U);
  constexpr std::size_t kSplitsAt = 28;
  for (std::size_t i = 0; i < 4; ++i)
    bytes[kSplitsAt + i] = static_cast<std::byte>(i == 3 ? 0x7F : 0xFF);
  mend_checksums(bytes);
  EXPECT_EQ(progressive::PmReader::count_splits(bytes), 5000U);
  EXPECT_LE(read_counted(bytes).peak, 256U * 5000 + kConstant);
  EXPECT_EQ(progressive::PmReader::count_splits(std::span(bytes).first(60)), 0U);
  EXPECT_LT(progressive::PmReader::count_splits(std::span(bytes).first(bytes.size() - 1)), 5000U);
}

// A base announces as many faces as its bytes may stand for: 20 MB of noise took 1.6 GB.
TEST(PmMemory, AnnouncedBaseTakesMemoryOnlyAsItIsDecoded) {
  std::mt19937 random(3);
  constexpr std::size_t kBytes = 2'000'000;
  Bytes payload(kBytes);
  for (std::byte& byte : payload)
    byte = static_cast<std::byte>(random());
  for (const unsigned bits : {0U, 16U}) {
    progressive::PmHeader header{.coordinate_bits = bits,
                                 .base_vertices = 4 * kBytes,
                                 .base_faces = 4 * kBytes,
                                 .splits = 1000,
                                 .grid = {.step = 1.0}};
    const auto head = progressive::pm_bytes(header, payload);
    Bytes bytes(head.begin(), head.end());
    bytes.insert(bytes.end(), payload.begin(), payload.end());
    const Taken taken = read_counted(bytes);
    EXPECT_NE(taken.error, "");
    // The bytes that wait for the end of the base, and the array that they are moved to.
    EXPECT_LE(taken.peak, 4 * kBytes + kConstant);
  }
}

}  // namespace
}  // namespace mesher::test
