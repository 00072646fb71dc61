#include "app/edit/subdivide_edit.h"

#include <gtest/gtest.h>

#include "app/document/json.h"
#include "app/document/session.h"
#include "app/document/shown.h"
#include "app/edit/edits.h"
#include "app/edit/model_edit.h"
#include "app/input/commands.h"
#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/subdivide/subdivide.h"
#include "tests/app/edit/editing.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"

namespace mesher::app {
namespace {

Soup creased_cube() {
  Soup soup = test::cube();
  soup.creases = {{0, 1, kInfinitelySharp}, {1, 3, 2.0F}};
  return soup;
}

TEST(Subdivision, SSplitsFacesIntoFourAndKeepsCamera) {
  Session s = session_with(test::cube());
  const Mesh coarse = s.document.model.mesh;
  const render::Camera camera = s.view.camera;
  press(s, "s");
  EXPECT_EQ(s.document.statistics.faces, 4 * coarse.face_count());
  EXPECT_TRUE(is_same(s.document.model.mesh, subdivide::subdivide(coarse, {}).mesh));
  EXPECT_TRUE(s.view.camera == camera);
  EXPECT_EQ(shown_level(s.document.edits), 1U);
  EXPECT_EQ(s.document.statistics.boundary_edges, 0U);
}

TEST(Subdivision, BowTiesKeepPositionThroughEditsAndUndo) {
  Session s = session_with(test::bow_tie({test::torus(8, 6), test::cube(), test::grid(6)}));
  const Mesh coarse = s.document.model.mesh;
  ASSERT_EQ(coarse.bow_tie_copies().size(), 3U);
  for (const char* keys : {"s", "l", "d", "r", "d", "s", "ctrl+z", "m", "ctrl+z", "ctrl+y", "d"}) {
    press(s, keys);
    ASSERT_EQ(s.document.model.mesh.bow_tie_copies().size(), 3U) << keys;
    for (const BowTieCopy& copy : s.document.model.mesh.bow_tie_copies())
      EXPECT_EQ(s.document.model.mesh.position(copy.v), glm::vec3(0.0F)) << keys;
    EXPECT_TRUE(s.document.model.mesh.vertex_sharpnesses().empty());
  }
  for (int i = 0; i < 12; ++i)
    press(s, "ctrl+z");
  EXPECT_TRUE(is_same(s.document.model.mesh, coarse));
}

TEST(Subdivision, RepeatedStepsEqualOneSubdivisionOfSeveralLevels) {
  Session s = session_with(creased_cube());
  const Mesh coarse = s.document.model.mesh;
  press(s, "s s s");
  EXPECT_TRUE(is_same(s.document.model.mesh, subdivide::subdivide(coarse, {.levels = 3}).mesh));
}

TEST(Subdivision, LevelsGoUpAndDownWithoutLoss) {
  Session s = session_with(creased_cube());
  std::vector<Mesh> levels{s.document.model.mesh};
  for (int i = 0; i < 3; ++i) {
    press(s, "s");
    levels.push_back(s.document.model.mesh);
  }
  for (std::uint32_t level = 3; level-- > 0;) {
    press(s, "shift+s");
    EXPECT_EQ(shown_level(s.document.edits), level);
    EXPECT_TRUE(is_same(s.document.model.mesh, levels[level]));
  }
  press(s, "shift+s");
  EXPECT_EQ(s.document.notice, "already at the coarsest level");
  press(s, "s s");
  EXPECT_TRUE(is_same(s.document.model.mesh, levels[2]));
}

TEST(Subdivision, UndoAndRedoRestoreLevel) {
  Session s = session_with(creased_cube());
  const Mesh coarse = s.document.model.mesh;
  press(s, "s s");
  const Mesh fine = s.document.model.mesh;
  press(s, "ctrl+z");
  EXPECT_EQ(shown_level(s.document.edits), 1U);
  press(s, "ctrl+z");
  EXPECT_EQ(shown_level(s.document.edits), 0U);
  EXPECT_TRUE(is_same(s.document.model.mesh, coarse));
  press(s, "ctrl+y ctrl+y");
  EXPECT_EQ(shown_level(s.document.edits), 2U);
  EXPECT_TRUE(is_same(s.document.model.mesh, fine));
  press(s, "shift+s shift+s");
  EXPECT_TRUE(is_same(s.document.model.mesh, coarse));
}

TEST(Subdivision, CombinesWithSimplificationInAnyOrder) {
  Session s = session_with(creased_cube());
  press(s, "s s s d d");
  EXPECT_EQ(shown_level(s.document.edits), 0U);  // the simplified model is not a level
  EXPECT_GT(s.document.statistics.crease_edges, 0U);
  const Mesh simplified = s.document.model.mesh;
  press(s, "s");
  EXPECT_EQ(s.document.statistics.faces, 4 * simplified.face_count());
  EXPECT_GT(s.document.statistics.crease_edges, 0U);
  press(s, "shift+s");
  EXPECT_TRUE(is_same(s.document.model.mesh, simplified));
  press(s, "ctrl+z ctrl+z ctrl+z ctrl+z");
  EXPECT_EQ(shown_level(s.document.edits), 3U);  // as before the simplification
  press(s, "shift+s");
  EXPECT_EQ(shown_level(s.document.edits), 2U);
}

TEST(Subdivision, CreaseEditStartsFromShownLevel) {
  Session s = session_with(test::cube());
  press(s, "s");
  const Mesh level = s.document.model.mesh;
  s.document.creases.selected = {level.edge(Halfedge(0))};
  request_crease_edit(s.document, {.kind = CreaseRequest::Kind::set, .value = 3.0F});
  run_waiting_edits(s.document);
  EXPECT_EQ(shown_level(s.document.edits), 0U);
  press(s, "shift+s");
  EXPECT_EQ(s.document.notice, "already at the coarsest level");
  press(s, "s shift+s");
  EXPECT_EQ(s.document.model.mesh.sharpness(Halfedge(0)), 3.0F);
  press(s, "ctrl+z ctrl+z ctrl+z shift+s");
  EXPECT_EQ(s.document.statistics.faces, 12U);
}

TEST(Subdivision, ChangedRulesRebuildLevel) {
  Session s = session_with(creased_cube());
  const Mesh coarse = s.document.model.mesh;
  press(s, "s s r");
  EXPECT_EQ(s.document.notice, "subdivision: loop, derose98");
  EXPECT_TRUE(is_same(
      s.document.model.mesh,
      subdivide::subdivide(coarse, {.levels = 2, .creases = subdivide::CreaseRules::derose98})
          .mesh));
  press(s, "m");
  EXPECT_TRUE(is_same(s.document.model.mesh,
                      subdivide::subdivide(coarse, {.levels = 2,
                                                    .scheme = subdivide::Scheme::butterfly,
                                                    .creases = subdivide::CreaseRules::derose98})
                          .mesh));
  press(s, "m m r");
  EXPECT_TRUE(is_same(s.document.model.mesh, subdivide::subdivide(coarse, {.levels = 2}).mesh));
  EXPECT_EQ(shown_level(s.document.edits), 2U);
}

TEST(Subdivision, RulesChangedAtLevelZeroAreKept) {
  Session s = session_with(test::cube());
  const Mesh coarse = s.document.model.mesh;
  press(s, "r");
  EXPECT_EQ(s.document.edits.history.undo_depth(), 0U);
  EXPECT_TRUE(is_same(s.document.model.mesh, coarse));
  EXPECT_EQ(s.document.notice, "subdivision: loop, derose98");
}

TEST(Subdivision, LimitSurfaceHasItsNormals) {
  Session s = session_with(creased_cube());
  const Mesh coarse = s.document.model.mesh;
  press(s, "s s");
  EXPECT_TRUE(shading_normals(s.document.edits).empty());
  press(s, "l");
  const subdivide::Subdivided expected = subdivide::subdivide(coarse, {.levels = 2, .limit = true});
  EXPECT_TRUE(is_same(s.document.model.mesh, expected.mesh));
  EXPECT_TRUE(std::ranges::equal(shading_normals(s.document.edits), expected.limit_normal));
  press(s, "l");
  EXPECT_TRUE(shading_normals(s.document.edits).empty());
  EXPECT_TRUE(is_same(s.document.model.mesh, subdivide::subdivide(coarse, {.levels = 2}).mesh));
}

TEST(Subdivision, LevelUsesRulesAtTimeOfRequest) {
  Session s = session_with(creased_cube());
  const Mesh coarse = s.document.model.mesh;
  run(s, "subdivide");
  run(s, "next_scheme");  // while the first edit is still queued
  run_waiting_edits(s.document);
  EXPECT_TRUE(is_same(s.document.model.mesh,
                      subdivide::subdivide(coarse, {.scheme = subdivide::Scheme::butterfly}).mesh));
  press(s, "ctrl+z");
  EXPECT_TRUE(is_same(s.document.model.mesh, subdivide::subdivide(coarse, {}).mesh));
}

TEST(Subdivision, ShownRulesAreThoseOfShownLevel) {
  Session s = session_with(creased_cube());
  press(s, "s s r");
  EXPECT_EQ(s.document.subdivide.creases, subdivide::CreaseRules::derose98);
  press(s, "ctrl+z");
  EXPECT_EQ(s.document.subdivide.creases, subdivide::CreaseRules::hoppe94);
  press(s, "ctrl+y");
  EXPECT_EQ(s.document.subdivide.creases, subdivide::CreaseRules::derose98);
  EXPECT_EQ(level_refusal(s.document, kMaxLevel + 1, {}), "already at the finest level");
  s.document.subdivide.scheme = subdivide::Scheme::butterfly;
  const MemoryLimit nothing(1);
  press(s, "s");
  EXPECT_NE(s.document.notice.find("of memory; "), std::string::npos) << s.document.notice;
  EXPECT_EQ(s.document.subdivide.scheme, subdivide::Scheme::loop);
}

TEST(Subdivision, UndoKeepsRulesRequestedAfterIt) {
  Session s = session_with(creased_cube());
  const Mesh coarse = s.document.model.mesh;
  press(s, "s s");
  run(s, "undo");
  run(s, "next_scheme");
  run_waiting_edits(s.document);
  EXPECT_TRUE(is_same(s.document.model.mesh,
                      subdivide::subdivide(coarse, {.scheme = subdivide::Scheme::butterfly}).mesh));
  EXPECT_EQ(s.document.subdivide.scheme, subdivide::Scheme::butterfly);
}

TEST(Subdivision, RulesWithSameResultAreNotAppliedAgain) {
  Session s = session_with(test::cube());
  press(s, "s r");
  EXPECT_EQ(s.document.edits.history.undo_depth(), 1U);
  EXPECT_EQ(s.document.edits.subdivision->rules.creases, subdivide::CreaseRules::derose98);
  request_same_level(s.document);
  EXPECT_FALSE(start_next_edit(s.document));
}

TEST(Subdivision, TakenBackEditCannotBeRedone) {
  Session s = session_with(creased_cube());
  EXPECT_FALSE(take_back_last_edit(s.document));
  press(s, "s");
  const Mesh level = s.document.model.mesh;
  press(s, "m");
  const std::uint64_t revision = s.document.edits.revision;
  EXPECT_TRUE(take_back_last_edit(s.document));
  EXPECT_TRUE(is_same(s.document.model.mesh, level));
  EXPECT_EQ(s.document.statistics.faces, level.face_count());
  EXPECT_EQ(shown_level(s.document.edits), 1U);
  EXPECT_EQ(s.document.subdivide.scheme, subdivide::Scheme::loop);
  EXPECT_EQ(s.document.edits.history.redo_depth(), 0U);
  EXPECT_GT(s.document.edits.revision, revision);
  EXPECT_TRUE(take_back_last_edit(s.document));
  EXPECT_EQ(shown_level(s.document.edits), 0U);
  EXPECT_EQ(s.document.statistics.faces, 12U);
}

TEST(Subdivision, TakingBackUndoRedoesEdit) {
  Session s = session_with(creased_cube());
  press(s, "s s shift+s shift+s");
  const Mesh coarse = s.document.model.mesh;
  press(s, "ctrl+z ctrl+z");
  EXPECT_EQ(shown_level(s.document.edits), 2U);
  EXPECT_TRUE(take_back_last_edit(s.document));
  EXPECT_EQ(shown_level(s.document.edits), 1U);
  EXPECT_TRUE(take_back_last_edit(s.document));
  EXPECT_EQ(shown_level(s.document.edits), 0U);
  EXPECT_TRUE(is_same(s.document.model.mesh, coarse));
  EXPECT_EQ(s.document.edits.history.undo_depth(), 4U);
}

TEST(Subdivision, OutOfMemoryIsRefusedWithSize) {
  Session s = session_with(test::torus(40, 40));
  const std::string finest = level_refusal(s.document, 12, {});
  EXPECT_NE(finest.find("subdividing 12 times would make"), std::string::npos) << finest;
  const MemoryLimit scarce(1'000'000'000);
  const std::string fine = level_refusal(s.document, 9, {});
  EXPECT_NE(fine.find(" GB of memory; "), std::string::npos) << fine;
}

TEST(Subdivision, CountsShownModelButAllowsLevelZero) {
  Session s = session_with(test::torus(100, 100));
  press(s, "s s s");
  const std::uint64_t twice = 2 * s.document.model.mesh.memory_bytes();
  const MemoryLimit scarce(twice);  // level 1 needs an eighth of that
  const std::string refusal = level_refusal(s.document, 1, {});
  EXPECT_NE(refusal.find("of memory; "), std::string::npos) << refusal;
  EXPECT_NE(level_refusal(s.document, 3, {.scheme = subdivide::Scheme::butterfly}), "");
  EXPECT_EQ(level_refusal(s.document, 0, {}), "");
  press(s, "shift+s");
  EXPECT_NE(s.document.notice.find("of memory; "), std::string::npos) << s.document.notice;
  EXPECT_EQ(shown_level(s.document.edits), 3U);
}

TEST(Subdivision, ModelIsCopiedOnce) {
  Session s = session_with(test::cube());
  request_subdivide(s.document);
  const auto task = start_next_edit(s.document);
  ASSERT_TRUE(task);
  task->perform(nullptr);
  task->finish(s.document);
  EXPECT_EQ(s.document.edits.subdivision->base, s.document.edits.opened);
}

TEST(Subdivision, EmptyModelGivesANotice) {
  Session s;
  press(s, "s");
  EXPECT_EQ(s.document.notice, "there is nothing to subdivide");
}

TEST(Subdivision, CarriesTextureCoordinatesOver) {
  Soup soup = test::cube();
  soup.attributes.texcoord.assign(soup.corners.size(), glm::vec2(0.25F, 0.75F));
  Session s = session_with(std::move(soup));
  press(s, "s");
  ASSERT_EQ(test::corners_of(s.document.model).texcoord.size(),
            s.document.model.mesh.halfedge_count());
  EXPECT_EQ(test::corners_of(s.document.model).texcoord.back(), glm::vec2(0.25F, 0.75F));
  press(s, "shift+s");
  EXPECT_EQ(test::corners_of(s.document.model).texcoord.size(),
            s.document.model.mesh.halfedge_count());
}

TEST(Subdivision, JsonContainsSubdivision) {
  Session s = session_with(test::cube());
  press(s, "s s l");
  const Json json = to_json(s);
  EXPECT_EQ(json["subdivision_level"], 2);
  EXPECT_EQ(json["subdivide"]["scheme"], "loop");
  EXPECT_EQ(json["subdivide"]["limit"], true);
  EXPECT_EQ(json["last_subdivision"]["faces"], 192);
}

TEST(Subdivision, CancelLeavesModelUnchanged) {
  Session s = session_with(test::torus(40, 40));
  request_subdivide(s.document);
  const auto task = start_next_edit(s.document);
  ASSERT_TRUE(task);
  EXPECT_EQ(task->title(), "Subdividing to level 1");
  Progress progress;
  progress.cancel();
  EXPECT_THROW(task->perform(&progress), Cancelled);
  EXPECT_EQ(shown_level(s.document.edits), 0U);
}

}  // namespace
}  // namespace mesher::app
