#include "app/document/history.h"

#include <gtest/gtest.h>

#include <new>

#include "engine/core/memory.h"
#include "engine/mesh/corner_attributes.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

namespace mesher::app {
namespace {

/// A model with edits that move one vertex each.
struct Edited {
  Edited() {
    model.mesh = build_mesh(test::grid(4)).mesh;
    stats = statistics(model.mesh);
  }
  Edit moved(std::uint32_t v, float z) const {
    Mesh after = model.mesh;
    after.set_position(Vertex(v), {0.0F, 0.0F, z});
    return {.name = "move " + std::to_string(v),
            .mesh = difference(model.mesh, after),
            .attributes = {},
            .before = stats,
            .after = statistics(after)};
  }
  void move(History& history, std::uint32_t v, float z) {
    history.perform(moved(v, z), model, stats);
  }
  float height(std::uint32_t v) const { return model.mesh.position(Vertex(v)).z; }

  Model model;
  Statistics stats;
};

TEST(History, UndoAndRedoRestoreModel) {
  Edited d;
  History history;
  d.move(history, 0, 5.0F);
  d.move(history, 1, 6.0F);
  EXPECT_EQ(history.undo_name(), "move 1");
  EXPECT_EQ(d.stats.box.max.z, 6.0F);
  history.undo(d.model, d.stats);
  EXPECT_EQ(d.height(1), 0.0F);
  EXPECT_EQ(d.stats.box.max.z, 5.0F);
  EXPECT_EQ(history.redo_name(), "move 1");
  history.undo(d.model, d.stats);
  EXPECT_EQ(d.height(0), 0.0F);
  EXPECT_EQ(history.undo_depth(), 0U);
  EXPECT_EQ(history.redo_depth(), 2U);
  history.redo(d.model, d.stats);
  history.redo(d.model, d.stats);
  EXPECT_EQ(d.height(1), 6.0F);
  EXPECT_EQ(d.stats.box.max.z, 6.0F);
}

TEST(History, TakenBackEditCannotBeRedone) {
  Edited d;
  History history;
  d.move(history, 0, 5.0F);
  const std::size_t bytes = history.memory_bytes();
  d.move(history, 1, 6.0F);
  history.take_back(d.model, d.stats);
  EXPECT_EQ(d.height(1), 0.0F);
  EXPECT_EQ(history.undo_depth(), 1U);
  EXPECT_EQ(history.redo_depth(), 0U);
  EXPECT_EQ(history.memory_bytes(), bytes);
}

TEST(History, TakeBackDropsUndoneEdits) {
  Edited d;
  History history;
  d.move(history, 0, 5.0F);
  d.move(history, 1, 6.0F);
  history.undo(d.model, d.stats);
  history.take_back(d.model, d.stats);
  EXPECT_EQ(d.height(0), 0.0F);
  EXPECT_EQ(history.redo_depth(), 0U);
  EXPECT_EQ(history.memory_bytes(), 0U);
}

/// An edit that replaces the model by a large one with texture coordinates.
Edit growth(const Edited& d) {
  const Mesh large = build_mesh(test::torus(500, 400)).mesh;
  CornerAttributes corners;
  corners.texcoord.assign(large.halfedge_count(), {0.5F, 0.5F});
  const Attributes attributes = to_wedges(large, std::move(corners));
  return {.name = "grow",
          .mesh = difference(d.model.mesh, large),
          .attributes = difference(d.model.attributes, attributes),
          .before = d.stats,
          .after = statistics(large)};
}

TEST(History, OutOfMemoryLeavesModelUnchanged) {
  int failures = 0;
  for (std::uint64_t bytes = 0;; bytes += test::kSanitized ? 3'000'000 : 2'000'000) {
    Edited d;
    const Mesh before = d.model.mesh;
    History history;
    Edit edit = growth(d);
    try {
      const MemoryLimit scarce(bytes);
      history.perform(std::move(edit), d.model, d.stats);
    } catch (const std::bad_alloc&) {
      ++failures;
    }
    if (history.undo_depth() == 1) break;
    EXPECT_TRUE(difference(before, d.model.mesh).is_empty());
    EXPECT_TRUE(d.model.attributes.is_empty());
    EXPECT_EQ(d.stats.faces, before.face_count());
    EXPECT_EQ(history.memory_bytes(), 0U);
    ASSERT_LT(failures, 100);
  }
  EXPECT_GT(failures, 5);
}

TEST(History, StepsOutliveTheirDifferences) {
  Edited d;
  const std::size_t one = d.moved(0, 1.0F).memory_bytes();
  History history(2 * one);
  std::vector<std::uint64_t> states{history.state()};
  for (std::uint32_t v = 0; v < 5; ++v) {
    d.move(history, v, 1.0F);
    states.push_back(history.state());
  }
  EXPECT_EQ(history.undo_depth(), 2U);
  EXPECT_EQ(history.steps().size(), 5U);
  EXPECT_EQ(history.done_steps(), 5U);
  history.undo(d.model, d.stats);
  EXPECT_EQ(history.state(), states[4]);
  EXPECT_EQ(history.steps().size(), 5U);
  EXPECT_EQ(history.done_steps(), 4U);
  history.redo(d.model, d.stats);
  EXPECT_EQ(history.state(), states[5]);
  history.undo(d.model, d.stats);
  d.move(history, 0, 2.0F);
  EXPECT_EQ(history.steps().size(), 5U);
  EXPECT_GT(history.state(), states[5]) << "no id is used twice";
  history.take_back(d.model, d.stats);
  EXPECT_EQ(history.state(), states[4]);
  EXPECT_EQ(history.steps().size(), 4U);
}

TEST(History, NewEditDropsUndoneEdits) {
  Edited d;
  History history;
  d.move(history, 0, 5.0F);
  history.undo(d.model, d.stats);
  d.move(history, 1, 6.0F);
  EXPECT_EQ(history.redo_depth(), 0U);
  EXPECT_EQ(history.undo_depth(), 1U);
}

TEST(History, BudgetDropsOldestEditsButNotLast) {
  Edited d;
  const std::size_t one = d.moved(0, 1.0F).memory_bytes();
  ASSERT_GT(one, 0U);
  History history(3 * one);
  for (std::uint32_t v = 0; v < 5; ++v)
    d.move(history, v, 1.0F);
  EXPECT_EQ(history.undo_depth(), 3U);
  EXPECT_LE(history.memory_bytes(), 3 * one);
  History tiny(1);
  d.move(tiny, 7, 1.0F);
  d.move(tiny, 8, 1.0F);
  EXPECT_EQ(tiny.undo_depth(), 1U);
  EXPECT_EQ(tiny.undo_name(), "move 8");
}

TEST(History, MemoryIsCounted) {
  Edited d;
  History history;
  d.move(history, 0, 5.0F);
  const std::size_t one = history.memory_bytes();
  d.move(history, 1, 5.0F);
  history.undo(d.model, d.stats);
  EXPECT_EQ(history.memory_bytes(), 2 * one);
  d.move(history, 2, 5.0F);
  EXPECT_EQ(history.memory_bytes(), 2 * one);
}

}  // namespace
}  // namespace mesher::app
