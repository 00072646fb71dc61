#include "app/edit/edit_runner.h"

#include <gtest/gtest.h>

#include <thread>

#include "app/edit/edits.h"
#include "app/edit/subdivide_edit.h"
#include "tests/support/meshes.h"

namespace mesher::app {
namespace {

using Request = void (*)(Document&);

class EditRunnerTest : public testing::Test {
 protected:
  EditRunnerTest() { show_torus(document_); }
  static void show_torus(Document& document) {
    Model model;
    model.mesh = build_mesh(test::torus(12, 10)).mesh;
    const Statistics stats = statistics(model.mesh);
    replace_model(document, std::move(model), stats, "torus.obj");
  }
  void ask(Request request) { request(document_); }

  Document document_;
  EditRunner runner_{document_, nullptr};
};

TEST_F(EditRunnerTest, RunsRequestedEditsInOrder) {
  EXPECT_FALSE(runner_.advance());
  for (const Request request :
       {request_collapse_edge, request_collapse_edge, request_undo, request_collapse_edge})
    ask(request);
  EXPECT_TRUE(runner_.advance());
  EXPECT_TRUE(runner_.is_running());
  EXPECT_EQ(runner_.job()->title(), "Collapsing an edge");
  EXPECT_EQ(document_.edits.waiting.size(), 3U);
  runner_.finish();
  EXPECT_FALSE(runner_.is_running());
  EXPECT_EQ(document_.statistics.faces, 236U);
  EXPECT_EQ(document_.edits.history.undo_depth(), 2U);
  test::expect_valid(document_.model.mesh);
}

TEST_F(EditRunnerTest, ResultEqualsThatOfScript) {
  Document script;
  show_torus(script);
  for (const Request request :
       {request_remove_tenth, request_remove_tenth, request_collapse_edge}) {
    ask(request);
    request(script);
  }
  runner_.finish();
  run_waiting_edits(script);
  EXPECT_TRUE(difference(document_.model.mesh, script.model.mesh).is_empty());
}

TEST_F(EditRunnerTest, CancelDropsRequestedEdits) {
  for (int i = 0; i < 50; ++i)
    ask(request_remove_tenth);
  runner_.advance();
  runner_.cancel();
  EXPECT_FALSE(runner_.is_running());
  EXPECT_EQ(document_.notice, "canceled");
  runner_.finish();
  EXPECT_TRUE(document_.edits.waiting.empty());
  EXPECT_EQ(document_.edits.history.undo_depth(), 0U);
}

TEST_F(EditRunnerTest, CancelDropsFinishedEdit) {
  ask(request_remove_tenth);
  runner_.advance();
  while (!runner_.job()->is_done())
    std::this_thread::yield();
  runner_.cancel();
  EXPECT_TRUE(runner_.advance());
  EXPECT_EQ(document_.statistics.faces, 240U);
  EXPECT_EQ(document_.notice, "canceled");
}

TEST_F(EditRunnerTest, CancelRestoresRulesOfShownLevel) {
  ask(request_subdivide);
  runner_.finish();
  ask(request_subdivide);
  runner_.advance();
  document_.subdivide.scheme = subdivide::Scheme::butterfly;
  apply_subdivide_settings(document_);
  runner_.cancel();
  runner_.finish();
  EXPECT_EQ(document_.subdivide, document_.edits.subdivision->rules);
  EXPECT_EQ(document_.subdivide.scheme, subdivide::Scheme::loop);
}

TEST_F(EditRunnerTest, StopLeavesModelUnchanged) {
  ask(request_remove_tenth);
  ask(request_remove_tenth);
  runner_.advance();
  runner_.stop();
  EXPECT_FALSE(runner_.is_running());
  EXPECT_FALSE(runner_.advance());
  EXPECT_EQ(document_.statistics.faces, 240U);
  EXPECT_EQ(document_.notice, "");
}

TEST_F(EditRunnerTest, UndoWithoutEditsGivesNotice) {
  ask(request_undo);
  EXPECT_TRUE(runner_.advance());
  EXPECT_FALSE(runner_.is_running());
  EXPECT_EQ(document_.notice, "nothing to undo");
}

}  // namespace
}  // namespace mesher::app
