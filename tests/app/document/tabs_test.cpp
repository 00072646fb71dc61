#include "app/document/tabs.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/app/edit/editing.h"

namespace mesher::app {
namespace {

class TabsTest : public testing::Test {
 protected:
  void open(Soup soup, const char* name) {
    add_tab(s_);
    Model model;
    model.mesh = build_mesh(std::move(soup)).mesh;
    model.name = name;
    show_model(s_, std::move(model), name);
  }
  std::string names() const {
    std::string names;
    for (std::size_t i = 0; i < tab_count(s_); ++i)
      names += document_of(s_, i).model.name;
    return names;
  }

  Session s_;
};

TEST_F(TabsTest, FirstModelNeedsNoTab) {
  open(test::cube(), "a");
  EXPECT_EQ(tab_count(s_), 1U);
  EXPECT_EQ(shown_tab(s_), 0U);
}

TEST_F(TabsTest, ModelsKeepTheirOrderWhicheverIsShown) {
  open(test::cube(), "a");
  open(test::tetrahedron(), "b");
  open(test::torus(20, 10), "c");
  open(test::grid(4), "d");
  for (const std::size_t tab : {0U, 3U, 1U, 2U, 2U, 0U, 1U}) {
    show_tab(s_, tab);
    EXPECT_EQ(names(), "abcd");
    EXPECT_EQ(shown_tab(s_), tab);
    EXPECT_EQ(s_.document.model.name, std::string(1, "abcd"[tab]));
    test::expect_valid(s_.document.model.mesh);
  }
  show_tab(s_, 0);
  open(test::cube(), "e");
  EXPECT_EQ(names(), "aebcd") << "beside the shown one";
}

TEST_F(TabsTest, EditsHistoryAndCameraStayWithTheirModel) {
  open(test::torus(20, 10), "a");
  press(s_, "d d ctrl+z 7");
  const render::Camera camera = s_.view.camera;
  open(test::cube(), "b");
  EXPECT_NE(s_.view.camera, camera);
  press(s_, "s");
  EXPECT_TRUE(has_unsaved_edits(document_of(s_, 0)));
  show_tab(s_, 0);
  EXPECT_EQ(s_.document.edits.history.undo_depth(), 1U);
  EXPECT_EQ(s_.document.edits.history.redo_depth(), 1U);
  EXPECT_EQ(s_.view.camera, camera);
  press(s_, "ctrl+y");
  EXPECT_EQ(s_.document.edits.history.undo_depth(), 2U);
  show_tab(s_, 1);
  press(s_, "ctrl+z");
  EXPECT_EQ(s_.document.statistics.faces, 12U);
}

TEST_F(TabsTest, GpuSeesAnotherMeshAtEachSwitch) {
  open(test::cube(), "a");
  open(test::tetrahedron(), "b");
  open(test::torus(20, 10), "c");
  std::set<std::uint64_t> seen{s_.document.model_generation};
  for (const std::size_t tab : {0U, 1U, 0U, 2U, 1U}) {
    show_tab(s_, tab);
    EXPECT_TRUE(seen.insert(s_.document.model_generation).second) << tab;
  }
  close_shown_tab(s_);
  EXPECT_TRUE(seen.insert(s_.document.model_generation).second);
}

TEST_F(TabsTest, HiddenModelFollowsTheWindow) {
  s_.view.window = {800, 600};
  open(test::cube(), "a");
  open(test::cube(), "b");
  resize(s_.view, s_.document.statistics.box, {300, 600}, {});
  const render::Camera framed = s_.view.camera;
  show_tab(s_, 0);
  EXPECT_EQ(s_.view.window, glm::dvec2(300, 600));
  EXPECT_NEAR(s_.view.camera.distance(), framed.distance(), 1e-9);
}

TEST_F(TabsTest, RulesAreCopiedAndThenIndependent) {
  open(test::cube(), "a");
  s_.document.simplify.rules.seed = 7;
  s_.document.subdivide.limit = !s_.document.subdivide.limit;
  const bool limit = s_.document.subdivide.limit;
  open(test::cube(), "b");
  EXPECT_EQ(s_.document.simplify.rules.seed, 7U);
  EXPECT_EQ(s_.document.subdivide.limit, limit);
  s_.document.simplify.rules.seed = 8;
  show_tab(s_, 0);
  EXPECT_EQ(s_.document.simplify.rules.seed, 7U);
}

TEST_F(TabsTest, ClosingShowsTheNextOrTheLast) {
  for (const char* name : {"a", "b", "c"})
    open(test::cube(), name);
  show_tab(s_, 1);
  const std::uint64_t closed = s_.document.opening;
  close_shown_tab(s_);
  EXPECT_EQ(names(), "ac");
  EXPECT_EQ(s_.document.model.name, "c");
  EXPECT_EQ(document_opened_as(s_, closed), nullptr);
  close_shown_tab(s_);
  EXPECT_EQ(names(), "a");
  EXPECT_EQ(s_.document.model.name, "a");
}

TEST_F(TabsTest, SampleIsClosedOnlyUnedited) {
  open(test::cube(), "sample");
  s_.sample = s_.document.opening;
  close_hidden_tab(s_, s_.sample);
  EXPECT_EQ(names(), "sample") << "it is shown";
  press(s_, "s");
  open(test::cube(), "b");
  close_hidden_tab(s_, s_.sample);
  EXPECT_EQ(tab_count(s_), 2U) << "it has edits";
  show_tab(s_, 0);
  press(s_, "ctrl+z");
  show_tab(s_, 1);
  close_hidden_tab(s_, s_.sample);
  EXPECT_EQ(names(), "b");
}

TEST_F(TabsTest, RunningEditKeepsItsModelShown) {
  open(test::cube(), "a");
  EXPECT_EQ(tab_refusal(s_.document), nullptr);
  s_.document.edits.is_changing = true;
  EXPECT_NE(tab_refusal(s_.document), nullptr);
  open(test::cube(), "b");
  EXPECT_EQ(tab_refusal(s_.document), nullptr);
}

}  // namespace
}  // namespace mesher::app
