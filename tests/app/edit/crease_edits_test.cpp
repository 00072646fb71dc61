#include "app/edit/crease_edits.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>

#include "app/document/session.h"
#include "app/document/shown.h"
#include "app/edit/edits.h"
#include "app/input/commands.h"
#include "engine/mesh/creases.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"

namespace mesher::app {
namespace {

using Kind = CreaseRequest::Kind;

/// A session with helpers that click edges, which are given by their two vertices.
class CreaseEdits : public testing::Test {
 protected:
  void show(Soup soup) {
    Model model;
    model.mesh = build_mesh(std::move(soup)).mesh;
    set_default_view(s_.view.camera);
    show_model(s_, std::move(model), "model.obj");
    s_.document.model.mesh.changes().clear();
  }
  void press(const char* keys) {
    for (const KeyPress& key : parse_keys(keys)) {
      run(s_, *command_for(key));
      run_waiting_edits(s_.document);
    }
  }
  void ask(const CreaseRequest& request) {
    request_crease_edit(s_.document, request);
    run_waiting_edits(s_.document);
  }
  Edge edge(std::uint32_t a, std::uint32_t b) const {
    return s_.document.model.mesh.find_edge(Vertex(a), Vertex(b));
  }
  /// A point of the window near the middle of the edge.
  glm::dvec2 at(std::uint32_t a, std::uint32_t b) const {
    const Mesh& mesh = s_.document.model.mesh;
    const glm::dvec3 p =
        glm::mix(glm::dvec3(mesh.position(Vertex(a))), glm::dvec3(mesh.position(Vertex(b))), 0.45);
    return s_.view.camera.places(s_.view.window).of(p) + glm::dvec2(0.0, 1.5);
  }
  void click(std::uint32_t a, std::uint32_t b, const EdgeClick& how = {}) {
    click_edge(s_.document, s_.view, at(a, b), how);
  }
  float sharpness(std::uint32_t a, std::uint32_t b) const {
    return s_.document.model.mesh.sharpness(Mesh::halfedge(edge(a, b)));
  }
  const std::vector<Edge>& selected() const { return s_.document.creases.selected; }
  const History& history() const { return s_.document.edits.history; }
  void expect_consistent() {
    test::expect_valid(s_.document.model.mesh);
    EXPECT_EQ(s_.document.statistics.crease_edges, statistics(s_.document.model.mesh).crease_edges);
  }

  Session s_;
};

TEST_F(CreaseEdits, CTogglesCreaseMode) {
  show(test::cube());
  press("c");
  EXPECT_TRUE(s_.document.creases.is_on);
  EXPECT_TRUE(shown_settings(s_.view.settings, s_.document).line_edges);
  EXPECT_FALSE(s_.view.settings.wireframe);
  click(6, 7);
  press("c");
  EXPECT_FALSE(s_.document.creases.is_on);
  EXPECT_FALSE(shown_settings(s_.view.settings, s_.document).line_edges);
  EXPECT_TRUE(selected().empty());
}

TEST_F(CreaseEdits, EscapeClearsSelectionThenLeavesModeAndNeverQuits) {
  show(test::cube());
  press("c");
  click(6, 7);
  press("esc");
  EXPECT_TRUE(selected().empty());
  EXPECT_TRUE(s_.document.creases.is_on);
  press("esc");
  EXPECT_FALSE(s_.document.creases.is_on);
  EXPECT_FALSE(shown_settings(s_.view.settings, s_.document).line_edges);
  press("esc");
  EXPECT_FALSE(s_.wants_quit);
}

TEST_F(CreaseEdits, ClickReplacesAndCtrlClickTogglesSelection) {
  show(test::cube());
  press("c");
  click(6, 7);
  EXPECT_EQ(selected(), std::vector<Edge>{edge(6, 7)});
  click(4, 6);
  EXPECT_EQ(selected(), std::vector<Edge>{edge(4, 6)});
  click(6, 7, {.toggles = true});
  EXPECT_EQ(selected().size(), 2U);
  click(4, 6, {.toggles = true});
  EXPECT_EQ(selected(), std::vector<Edge>{edge(6, 7)});
  click_edge(s_.document, s_.view, {2, 2}, {.toggles = true});
  EXPECT_EQ(selected().size(), 1U) << "Ctrl+click beside the edges keeps the selection";
  click_edge(s_.document, s_.view, {2, 2}, {});
  EXPECT_TRUE(selected().empty());
}

TEST_F(CreaseEdits, ShiftClickAndDoubleClickSelectChain) {
  show(test::grid(6));
  s_.view.camera.set_view(render::View::front);
  press("c");
  click(22, 23, {.chain = true});
  EXPECT_EQ(selected().size(), 6U);
  click(22, 23);
  EXPECT_EQ(selected().size(), 1U);
  click(22, 23, {.is_second = true});
  EXPECT_EQ(selected().size(), 6U);
  // With Ctrl, the chain follows what the first click did.
  click(9, 16, {.toggles = true});
  EXPECT_EQ(selected().size(), 7U);
  click(9, 16, {.toggles = true, .is_second = true});
  EXPECT_EQ(selected().size(), 12U);
  click(9, 16, {.toggles = true});
  click(9, 16, {.toggles = true, .is_second = true});
  EXPECT_EQ(selected().size(), 6U);
  click(9, 16, {.toggles = true, .chain = true});
  EXPECT_EQ(selected().size(), 12U);
  click(9, 16, {.toggles = true, .chain = true});
  EXPECT_EQ(selected().size(), 6U);
}

TEST_F(CreaseEdits, KeysChangeSharpnessInUndoableSteps) {
  show(test::cube());
  press("c");
  click(6, 7);
  click(4, 7, {.toggles = true});
  press("+");
  EXPECT_EQ(sharpness(6, 7), 1.0F);
  EXPECT_EQ(sharpness(4, 7), 1.0F);
  EXPECT_EQ(history().undo_name(), "make 2 edges sharper -> 1");
  press("+");
  press("i");
  EXPECT_EQ(sharpness(6, 7), kInfinitelySharp);
  EXPECT_EQ(history().undo_name(), "make 2 edges infinitely sharp");
  expect_consistent();
  EXPECT_EQ(s_.document.statistics.crease_edges, 2U);
  press("-");
  EXPECT_EQ(sharpness(6, 7), kMaxFiniteSharpness);
  press("x");
  EXPECT_EQ(s_.document.statistics.crease_edges, 0U);
  EXPECT_EQ(history().undo_name(), "make 2 edges smooth");
  EXPECT_EQ(history().undo_depth(), 5U);
  expect_consistent();
  press("ctrl+z");
  EXPECT_EQ(sharpness(4, 7), kMaxFiniteSharpness);
  EXPECT_EQ(selected().size(), 2U) << "the edges are the same";
  press("ctrl+z ctrl+z ctrl+z");
  EXPECT_EQ(sharpness(4, 7), 1.0F);
  press("ctrl+y");
  EXPECT_EQ(sharpness(4, 7), 2.0F);
  expect_consistent();
}

TEST_F(CreaseEdits, ChangeLogHoldsOnlyChangedEdges) {
  show(test::torus(40, 20));
  press("c");
  s_.document.creases.selected = {s_.document.model.mesh.edge(Halfedge(100)),
                                  s_.document.model.mesh.edge(Halfedge(500))};
  ask({.kind = Kind::set, .value = 2.5F});
  EXPECT_EQ(history().undo_name(), "set 2 edges to sharpness 2.5");
  const ChangeLog& changes = s_.document.model.mesh.changes();
  EXPECT_FALSE(changes.is_whole(GpuArray::edge_class));
  std::uint32_t noted = 0;
  for (const ChangedRange range : changes.merged(GpuArray::edge_class))
    noted += range.end - range.begin;
  EXPECT_EQ(noted, 4U);
  EXPECT_TRUE(changes.merged(GpuArray::position).empty());
}

TEST_F(CreaseEdits, DragIsOneUndoStep) {
  show(test::cube());
  press("c");
  click(6, 7);
  press("i");
  for (const float value : {1.0F, 3.0F, 2.5F})
    ask({.kind = Kind::set, .value = value, .drag = 1});
  EXPECT_EQ(sharpness(6, 7), 2.5F);
  EXPECT_EQ(history().undo_depth(), 2U);
  ask({.kind = Kind::set, .value = 7.0F, .drag = 2});
  EXPECT_EQ(history().undo_depth(), 3U);
  press("ctrl+z");
  EXPECT_EQ(sharpness(6, 7), 2.5F);
  press("ctrl+z");
  EXPECT_EQ(sharpness(6, 7), kInfinitelySharp);
  press("ctrl+y ctrl+y");
  EXPECT_EQ(sharpness(6, 7), 7.0F);
  expect_consistent();
}

TEST_F(CreaseEdits, DragBackToStartLeavesNoUndoStep) {
  show(test::cube());
  press("c");
  click(6, 7);
  ask({.kind = Kind::set, .value = 4.0F});
  ask({.kind = Kind::set, .value = 6.0F, .drag = 1});
  ask({.kind = Kind::set, .value = 4.0F, .drag = 1});
  EXPECT_EQ(history().undo_depth(), 1U);
  EXPECT_EQ(history().redo_depth(), 0U);
  EXPECT_EQ(sharpness(6, 7), 4.0F);
  expect_consistent();
}

TEST_F(CreaseEdits, UndoDuringDragKeepsEarlierStep) {
  show(test::cube());
  press("c");
  click(6, 7);
  press("+");
  ask({.kind = Kind::set, .value = 5.0F, .drag = 1});
  press("ctrl+z");
  ask({.kind = Kind::set, .value = 6.0F, .drag = 1});
  EXPECT_EQ(history().undo_depth(), 2U);
  press("ctrl+z");
  EXPECT_EQ(sharpness(6, 7), 1.0F);
}

TEST_F(CreaseEdits, TagByAngleAndClearAll) {
  show(test::cube());
  press("shift+c");
  EXPECT_EQ(s_.document.statistics.crease_edges, 12U);
  EXPECT_EQ(history().undo_name(), "mark 12 edges by an angle of 40 degrees");
  press("shift+c");
  EXPECT_EQ(s_.document.notice,
            "no unmarked edge has face normals that differ by more than 40 degrees");
  press("ctrl+a");
  EXPECT_TRUE(s_.document.creases.is_on);
  EXPECT_EQ(selected().size(), 12U);
  ask({.kind = Kind::clear_all});
  EXPECT_EQ(s_.document.statistics.crease_edges, 0U);
  EXPECT_EQ(history().undo_name(), "clear all creases (12 edges)");
  expect_consistent();
  ask({.kind = Kind::clear_all});
  EXPECT_EQ(s_.document.notice, "there are no creases");
  EXPECT_EQ(history().undo_depth(), 2U);
  press("ctrl+z ctrl+z");
  EXPECT_EQ(s_.document.statistics.crease_edges, 0U);
  press("ctrl+a");
  EXPECT_EQ(s_.document.notice, "there are no creases");
}

TEST_F(CreaseEdits, EmptySelectionGivesNotice) {
  show(test::cube());
  for (const char* key : {"+", "-", "i", "x", "delete"}) {
    press(key);
    EXPECT_EQ(s_.document.notice, "no edge is selected") << key;
  }
  EXPECT_EQ(history().undo_depth(), 0U);
}

TEST_F(CreaseEdits, BoundaryEdgeCanBeSelectedButNotSharpened) {
  show(test::grid(4));
  s_.view.camera.set_view(render::View::front);
  press("c");
  click(1, 2);
  EXPECT_EQ(selected(), std::vector<Edge>{edge(1, 2)});
  EXPECT_NE(s_.document.notice.find("boundary"), std::string::npos);
  press("+");
  EXPECT_NE(s_.document.notice.find("boundary"), std::string::npos);
  EXPECT_EQ(history().undo_depth(), 0U);
  click(6, 7, {.toggles = true});
  press("+");
  EXPECT_EQ(sharpness(1, 2), 0.0F);
  EXPECT_EQ(sharpness(6, 7), 1.0F);
  EXPECT_EQ(history().undo_name(), "make 1 edge sharper -> 1");
}

TEST_F(CreaseEdits, SimplifyAndUndoClearSelection) {
  show(test::torus(12, 10));
  press("c");
  s_.document.creases.selected = {s_.document.model.mesh.edge(Halfedge(7))};
  s_.document.creases.hovered = s_.document.creases.selected.front();
  press("d");
  EXPECT_TRUE(selected().empty());
  EXPECT_FALSE(s_.document.creases.hovered.is_valid());
  EXPECT_TRUE(s_.document.creases.is_on);
  s_.document.creases.selected = {s_.document.model.mesh.edge(Halfedge(7))};
  press("ctrl+z");
  EXPECT_TRUE(selected().empty());
  s_.document.creases.selected = {s_.document.model.mesh.edge(Halfedge(7))};
  show(test::cube());
  EXPECT_TRUE(selected().empty());
}

TEST_F(CreaseEdits, RequestAppliesToSelectionWhenItRuns) {
  show(test::torus(12, 10));
  press("c");
  s_.document.creases.selected = {s_.document.model.mesh.edge(Halfedge(7))};
  run(s_, "simplify");
  run(s_, "sharpen");
  run_waiting_edits(s_.document);
  EXPECT_EQ(s_.document.notice, "no edge is selected");
  expect_consistent();
}

TEST_F(CreaseEdits, SimplifyFromOpenedModelKeepsItsCreases) {
  show(test::torus(12, 10));
  const auto simplify_to = [&](std::uint32_t faces) {
    request_simplify_to(s_.document, faces);
    run_waiting_edits(s_.document);
  };
  simplify_to(150);
  simplify_to(240);
  press("c");
  s_.document.creases.selected = crease_chain(s_.document.model.mesh, edge(0, 10));
  std::sort(s_.document.creases.selected.begin(), s_.document.creases.selected.end());
  const std::size_t tagged = selected().size();
  ASSERT_GT(tagged, 4U);
  press("i");
  simplify_to(150);
  EXPECT_GT(s_.document.statistics.crease_edges, 0U);
  simplify_to(240);
  EXPECT_EQ(s_.document.statistics.crease_edges, tagged);
  press("ctrl+z ctrl+z ctrl+z");
  EXPECT_EQ(s_.document.statistics.crease_edges, 0U);
  simplify_to(239);
  simplify_to(240);
  EXPECT_EQ(s_.document.statistics.crease_edges, 0U) << "undone creases are not restored";
}

TEST_F(CreaseEdits, AttributesAreUnchanged) {
  show(test::cube());
  CornerAttributes corners;
  corners.texcoord.assign(36, glm::vec2(0.5F));
  s_.document.model.attributes = to_wedges(s_.document.model.mesh, std::move(corners));
  press("shift+c");
  EXPECT_EQ(test::corners_of(s_.document.model).texcoord.size(), 36U);
  press("ctrl+z");
  EXPECT_EQ(test::corners_of(s_.document.model).texcoord.size(), 36U);
}

TEST_F(CreaseEdits, HoverReportsChangeOfEdge) {
  show(test::cube());
  EXPECT_FALSE(hover_edge(s_.document, s_.view, at(6, 7))) << "not while the mode is off";
  press("c");
  EXPECT_TRUE(hover_edge(s_.document, s_.view, at(6, 7)));
  EXPECT_EQ(s_.document.creases.hovered, edge(6, 7));
  EXPECT_FALSE(hover_edge(s_.document, s_.view, at(6, 7)));
  EXPECT_EQ(marked_edges(s_.document.creases).hovered, edge(6, 7));
  EXPECT_TRUE(hover_edge(s_.document, s_.view, std::nullopt));
  EXPECT_FALSE(s_.document.creases.hovered.is_valid());
}

TEST_F(CreaseEdits, SelectedSharpnessIgnoresBoundaryEdges) {
  show(test::grid(4));
  Mesh& mesh = s_.document.model.mesh;
  mesh.set_sharpness(edge(6, 7), 2.0F);
  mesh.set_sharpness(edge(7, 8), 3.0F);
  s_.document.creases.selected = {edge(6, 7)};
  EXPECT_FALSE(selected_sharpness(s_.document.model.mesh, s_.document.creases).is_mixed());
  EXPECT_EQ(selected_sharpness(s_.document.model.mesh, s_.document.creases).most, 2.0F);
  s_.document.creases.selected = {edge(1, 2), edge(6, 7), edge(7, 8)};
  std::sort(s_.document.creases.selected.begin(), s_.document.creases.selected.end());
  EXPECT_EQ(selected_sharpness(s_.document.model.mesh, s_.document.creases).edges, 2U);
  EXPECT_TRUE(selected_sharpness(s_.document.model.mesh, s_.document.creases).is_mixed());
  s_.document.creases.selected = {edge(1, 2)};
  EXPECT_EQ(selected_sharpness(s_.document.model.mesh, s_.document.creases).edges, 0U);
}

TEST(ChangedSharpness, RangesFromZeroOverTenToInfinity) {
  EXPECT_EQ(changed_sharpness(0.0F, -1.0F), 0.0F);
  EXPECT_EQ(changed_sharpness(0.5F, -1.0F), 0.0F);
  EXPECT_EQ(changed_sharpness(0.0F, 1.0F), 1.0F);
  EXPECT_EQ(changed_sharpness(9.5F, 1.0F), 10.0F);
  EXPECT_EQ(changed_sharpness(10.0F, 1.0F), kInfinitelySharp);
  EXPECT_EQ(changed_sharpness(kInfinitelySharp, 1.0F), kInfinitelySharp);
  EXPECT_EQ(changed_sharpness(kInfinitelySharp, -1.0F), 10.0F);
  EXPECT_EQ(changed_sharpness(20.0F, -1.0F), 19.0F);
}

}  // namespace
}  // namespace mesher::app
