#include <gtest/gtest.h>
#include <mesher/error.h>
#include <mesher/progressive_mesh.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/temp_folder.h"

namespace mesher {
namespace {

Asset small_bunny() {
  return Asset::load(MESHER_SOURCE_DIR "/assets/bunny_1k.obj");
}

/// Replaces the changed parts of a copy, as a program with a GPU does.
template <class T>
void update(std::vector<T>& copy, std::span<const T> now, const std::vector<ElementRange>& ranges) {
  copy.resize(now.size());
  for (const ElementRange& range : ranges)
    std::copy(now.begin() + range.begin, now.begin() + range.end, copy.begin() + range.begin);
}

TEST(ProgressiveMesh, FullDetailIsTheModel) {
  const Asset bunny = small_bunny();
  ProgressiveMesh levels(bunny);
  EXPECT_EQ(levels.level(), levels.level_count());
  EXPECT_EQ(levels.face_count(levels.level_count()), bunny.face_count());
  const auto sorted = [](std::span<const std::array<float, 3>> positions) {
    std::vector<std::array<float, 3>> copy(positions.begin(), positions.end());
    std::ranges::sort(copy);
    return copy;
  };
  EXPECT_EQ(sorted(levels.positions()), sorted(bunny.positions()));
  EXPECT_FALSE(levels.refine());
}

TEST(ProgressiveMesh, KeepsAttributesInFiles) {
  const test::TempFolder folder;
  const std::filesystem::path obj = folder / "square.obj";
  std::ofstream(obj) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 1\nv 2 1 1\n"
                     << "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.25\nvt 0.5 0.75\n"
                     << "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\nf 2/2 5/5 6/6\nf 2/2 6/6 3/3\n";
  ProgressiveMesh levels(Asset::load(obj), {.base_faces = 1});
  ASSERT_GT(levels.level_count(), 0U);
  levels.save(folder / "square.pm");
  ProgressiveMesh read = ProgressiveMesh::load(folder / "square.pm");
  for (const std::uint32_t level : {levels.level_count(), 0U}) {
    levels.set_level(level);
    read.set_level(level);
    levels.current().save(folder / "a.obj");
    read.current().save(folder / "b.obj");
    const std::string a = test::read_bytes(folder / "a.obj");
    EXPECT_NE(a.find("vt "), std::string::npos);
    EXPECT_EQ(a, test::read_bytes(folder / "b.obj"));
  }
}

TEST(ProgressiveMesh, ChangedRangesKeepACopyUpToDate) {
  ProgressiveMesh levels(small_bunny());
  std::vector<std::array<float, 3>> positions;
  std::vector<std::uint32_t> indices;
  const auto follow = [&] {
    const ChangedRanges changes = levels.take_changes();
    update(positions, levels.positions(), changes.positions);
    update(indices, levels.indices(), changes.indices);
    EXPECT_TRUE(std::ranges::equal(positions, levels.positions()));
    EXPECT_TRUE(std::ranges::equal(indices, levels.indices()));
    return changes;
  };
  follow();
  levels.set_level(0);
  follow();
  EXPECT_FALSE(levels.coarsen());
  EXPECT_TRUE(levels.refine());
  EXPECT_LT(follow().indices.size(), 20U);
  levels.set_face_count(500);
  EXPECT_LE(levels.indices().size() / 3, 500U);
  follow();
  EXPECT_TRUE(levels.coarsen());
  follow();
  EXPECT_TRUE(levels.take_changes().indices.empty());
}

TEST(ProgressiveMesh, FilesKeepEveryLevel) {
  const test::TempFolder folder;
  ProgressiveMesh levels(small_bunny(), {.base_faces = 100});
  levels.set_level(7);
  levels.save(folder / "b.pm");
  EXPECT_EQ(levels.level(), 7U);
  ProgressiveMesh read = ProgressiveMesh::load(folder / "b.pm");
  EXPECT_EQ(read.level_count(), levels.level_count());
  read.set_level(7);
  EXPECT_TRUE(std::ranges::equal(read.positions(), levels.positions()));
  EXPECT_EQ(Asset::load(folder / "b.pm").face_count(), read.face_count(read.level_count()));
  EXPECT_THROW(levels.save(folder / "b.pm", 3), UsageError);

  const std::string bytes = test::read_bytes(folder / "b.pm");
  folder.write("short.pm", bytes.substr(0, bytes.size() / 2));
  const ProgressiveMesh damaged = ProgressiveMesh::load(folder / "short.pm");
  EXPECT_FALSE(damaged.damage().empty());
  EXPECT_THROW(Asset::load(folder / "short.pm"), InputError) << "not even a level is what it was";
  EXPECT_LT(damaged.level_count(), levels.level_count());
}

TEST(ProgressiveMesh, LevelsKeepAttributes) {
  const Asset bunny = small_bunny().subdivide({.levels = 1, .limit = true});
  ProgressiveMesh levels(bunny);
  levels.set_face_count(600);
  const Asset level = levels.current();
  EXPECT_EQ(level.attributes(), bunny.attributes());
  EXPECT_EQ(level.face_count(), levels.indices().size() / 3);
  EXPECT_THROW(ProgressiveMesh{Asset()}, InputError);
}

}  // namespace
}  // namespace mesher
