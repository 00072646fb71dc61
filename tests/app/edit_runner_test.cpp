#include "app/edit_runner.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/support/meshes.h"

namespace mesher::app {
namespace {

using Kind = EditRequest::Kind;

class EditRunnerTest : public testing::Test {
 protected:
  EditRunnerTest() { show_torus(session_); }
  static void show_torus(Session& session) {
    Model model;
    model.mesh = build_mesh(test::torus(12, 10)).mesh;
    show_model(session, std::move(model), "torus.obj");
  }
  void ask(Kind kind) { request_edit(session_, {kind}); }

  Session session_;
  EditRunner runner_{session_, nullptr};
};

TEST_F(EditRunnerTest, DoesInOrderWhatWaits) {
  EXPECT_FALSE(runner_.advance());
  for (const Kind kind : {Kind::remove_edge, Kind::remove_edge, Kind::undo, Kind::remove_edge})
    ask(kind);
  EXPECT_TRUE(runner_.advance());
  EXPECT_TRUE(runner_.is_running());
  EXPECT_EQ(runner_.job()->title(), "Collapsing an edge");
  EXPECT_EQ(session_.edits.waiting.size(), 3U);
  runner_.finish();
  EXPECT_FALSE(runner_.is_running());
  EXPECT_EQ(session_.statistics.faces, 236U);
  EXPECT_EQ(session_.edits.history.undo_depth(), 2U);
  test::expect_valid(session_.model.mesh);
}

TEST_F(EditRunnerTest, GivesTheSameAsAScript) {
  Session script;
  show_torus(script);
  for (const Kind kind : {Kind::remove_tenth, Kind::remove_tenth, Kind::remove_edge}) {
    ask(kind);
    request_edit(script, {kind});
  }
  runner_.finish();
  run_waiting_edits(script);
  EXPECT_TRUE(difference(session_.model.mesh, script.model.mesh).is_empty());
}

TEST_F(EditRunnerTest, CancellingForgetsWhatWaitsToo) {
  session_.edits.waiting.assign(50, {Kind::remove_tenth});
  runner_.advance();
  runner_.cancel();
  runner_.finish();
  EXPECT_TRUE(session_.edits.waiting.empty());
  EXPECT_EQ(session_.edits.history.undo_depth(), 0U);
}

TEST_F(EditRunnerTest, WhatIsDoneButCancelledIsDropped) {
  ask(Kind::remove_tenth);
  runner_.advance();
  while (!runner_.job()->is_done())
    std::this_thread::yield();
  runner_.cancel();
  EXPECT_TRUE(runner_.advance());
  EXPECT_EQ(session_.statistics.faces, 240U);
  EXPECT_EQ(session_.notice, "cancelled");
}

TEST_F(EditRunnerTest, CancellingTakesTheRulesBackToThoseOfTheLevelShown) {
  ask(Kind::finer);
  runner_.finish();
  ask(Kind::finer);
  runner_.advance();
  session_.subdivide.scheme = Scheme::butterfly;
  apply_subdivide_settings(session_);
  runner_.cancel();
  runner_.finish();
  EXPECT_EQ(session_.subdivide, session_.edits.subdivision->settings);
  EXPECT_EQ(session_.subdivide.scheme, Scheme::loop);
}

TEST_F(EditRunnerTest, StoppingLeavesTheModelAlone) {
  ask(Kind::remove_tenth);
  ask(Kind::remove_tenth);
  runner_.advance();
  runner_.stop();
  EXPECT_FALSE(runner_.is_running());
  EXPECT_FALSE(runner_.advance());
  EXPECT_EQ(session_.statistics.faces, 240U);
  EXPECT_EQ(session_.notice, "");
}

TEST_F(EditRunnerTest, NothingToUndoIsSaidAtOnce) {
  ask(Kind::undo);
  EXPECT_TRUE(runner_.advance());
  EXPECT_FALSE(runner_.is_running());
  EXPECT_EQ(session_.notice, "nothing to undo");
}

}  // namespace
}  // namespace mesher::app
