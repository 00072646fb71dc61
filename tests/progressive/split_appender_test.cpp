#include "engine/progressive/split_appender.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <new>
#include <vector>

#include "engine/core/memory.h"
#include "engine/mesh/outgoing.h"
#include "engine/progressive/build.h"
#include "engine/progressive/parent_fan.h"
#include "tests/progressive/checks.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

/// A progressive mesh and its splits as a file stores them.
struct Told {
  progressive::ProgressiveMesh mesh;
  std::vector<progressive::NewSplit> splits;

  explicit Told(const Mesh& full)
      : mesh(std::move(progressive::make_progressive(full, {.target_faces = 20}).mesh)) {
    for (std::uint32_t i = 0; i < mesh.split_count(); ++i) {
      mesh.go_to(i);
      splits.push_back(mesh.next_split());
    }
  }
  progressive::ProgressiveMesh base() {
    mesh.go_to(0);
    return progressive::ProgressiveMesh(Mesh(mesh.mesh()));
  }
};

void append(progressive::ProgressiveMesh& mesh, std::span<const progressive::NewSplit> splits,
            std::uint32_t room) {
  progressive::SplitAppender appender(mesh, room);
  Array<Halfedge> memory;
  for (const progressive::NewSplit& split : splits)
    appender.append(split, progressive::gather_fan(mesh.mesh(), split.parent, memory));
}

TEST(SplitAppender, BatchEqualsOneByOne) {
  Told told(built(torus(14, 9)).mesh);
  const auto count = static_cast<std::uint32_t>(told.splits.size());
  ASSERT_GT(count, 50U);
  for (const std::uint32_t more : {0U, 100U}) {
    progressive::ProgressiveMesh mesh = told.base();
    append(mesh, std::span(told.splits).first(count / 2), count / 2);
    append(mesh, std::span(told.splits).subspan(count / 2), count - count / 2 + more);
    told.mesh.go_to(count);
    expect_same(told.mesh, mesh);
    EXPECT_EQ(mesh.mesh().vertex_count(), told.mesh.mesh().vertex_count())
        << "no capacity is left over";
    examine_levels(mesh, 20);
  }
}

TEST(SplitAppender, WithoutSplitsNothingChanges) {
  Told told(built(torus(6, 5)).mesh);
  progressive::ProgressiveMesh mesh = told.base();
  append(mesh, {}, 1000);
  progressive::ProgressiveMesh same = told.base();
  expect_same(same, mesh);
}

TEST(SplitAppender, LogsChangesOrMarksWholeArrays) {
  Told told(built(torus(14, 9)).mesh);
  progressive::ProgressiveMesh mesh = told.base();
  mesh.mesh().changes().clear();
  append(mesh, std::span(told.splits).first(1), 1);
  EXPECT_FALSE(mesh.mesh().changes().is_empty());
  EXPECT_FALSE(mesh.mesh().changes().is_whole(GpuArray::position));
  mesh.mesh().changes().note_all();
  append(mesh, std::span(told.splits).subspan(1), 1000);
  EXPECT_TRUE(mesh.mesh().changes().is_whole(GpuArray::origin));
}

TEST(SplitAppender, OutOfMemoryLeavesMeshUnchanged) {
  Told told(built(torus(14, 9)).mesh);
  int refusals = 0;
  for (std::uint64_t bytes = 1000; bytes < 100'000; bytes += 1000) {
    progressive::ProgressiveMesh mesh = told.base();
    std::uint32_t appended = 0;
    try {
      const MemoryLimit scarce(bytes);
      for (const progressive::NewSplit& split : told.splits) {
        mesh.append(split);
        ++appended;
      }
    } catch (const std::bad_alloc&) {
      ++refusals;
    }
    ASSERT_EQ(mesh.split_count(), appended);
    ASSERT_EQ(mesh.level(), appended);
    examine_levels(mesh, 10);
    append(mesh, std::span(told.splits).subspan(appended), 1000);
    told.mesh.go_to(told.mesh.split_count());
    expect_same(told.mesh, mesh);
    ASSERT_FALSE(HasFailure()) << bytes << " bytes";
  }
  EXPECT_GT(refusals, 10);
}

}  // namespace
}  // namespace mesher::test
