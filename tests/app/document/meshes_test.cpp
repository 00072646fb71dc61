#include "app/document/meshes.h"

#include <gtest/gtest.h>

#include "app/document/session.h"
#include "app/edit/edit_text.h"
#include "engine/io/read.h"
#include "engine/mesh/parts.h"
#include "tests/app/edit/editing.h"
#include "tests/support/gltf_scene_file.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

/// A session that shows test::scene_file: nodes 0 "root" above 1 "a" (above 2 "eye") and 3 "b".
class MeshesTest : public testing::Test {
 protected:
  MeshesTest() {
    show_model(session_,
               io::read_model(folder_.write("s.gltf", test::scene_file()), {.keeps_scene = true}),
               folder_ / "s.gltf");
  }
  Document& document() { return session_.document; }

  test::TempFolder folder_;
  Session session_;
};

TEST_F(MeshesTest, HidesNodesWithWhatIsBelow) {
  show_node(document(), 0, false);
  EXPECT_EQ(document().hidden, (scene::HiddenNodes{true, true, true, true, false}));
  show_node(document(), 1, true);
  EXPECT_EQ(document().hidden, (scene::HiddenNodes{true, false, false, true, false}));
  show_node(document(), 0, true);
  EXPECT_TRUE(document().hidden.empty());
}

TEST_F(MeshesTest, IsolatesANodeOrTheChosenMesh) {
  EXPECT_NE(need_chosen(document()), nullptr);
  isolate_node(document(), 3);
  EXPECT_EQ(document().hidden, (scene::HiddenNodes{true, true, true, false, true}));
  EXPECT_EQ(need_hidden(document()), nullptr);
  choose_mesh(document(), 0);
  EXPECT_EQ(need_chosen(document()), nullptr);
  EXPECT_EQ(document().notice, "edits apply to sheet only");
  isolate_chosen(document());
  EXPECT_EQ(document().hidden, (scene::HiddenNodes{true, false, true, false, true}));
  show_all_nodes(document());
  EXPECT_NE(need_hidden(document()), nullptr);
}

TEST_F(MeshesTest, CountsFacesAndKnowsMeshesWithFaces) {
  EXPECT_EQ(face_counts(document().model.attributes, 2), (std::vector<std::uint32_t>{4, 0}));
  EXPECT_EQ(face_count_of(document().model.attributes, 0), 4U);
  EXPECT_TRUE(has_mesh(document(), kNone));
  EXPECT_TRUE(has_mesh(document(), 0));
  EXPECT_FALSE(has_mesh(document(), 1)) << "it has points alone";
  EXPECT_FALSE(has_mesh(document(), 2));
}

TEST_F(MeshesTest, ListsNodesThatLeadToFaces) {
  EXPECT_EQ(nodes_with_faces(*document().model.scene), (std::vector<std::uint32_t>{0, 1, 3}));
}

TEST_F(MeshesTest, AnotherModelStartsWithAllMeshesShown) {
  choose_mesh(document(), 0);
  show_node(document(), 0, false);
  document().playback = {.animation = 0, .time_s = 1.0, .is_playing = true};
  show_model(session_, Model(), "empty.obj");
  EXPECT_TRUE(document().hidden.empty());
  EXPECT_EQ(document().chosen_mesh, kNone);
  EXPECT_FALSE(document().playback.is_on());
}

/// Two grids as two meshes of a scene.
Model two_grids() {
  Model model;
  std::vector<Shape> shapes;
  for (std::uint32_t m = 0; m < 2; ++m) {
    Shape& shape = shapes.emplace_back(Shape{test::built(test::grid(10)).mesh, {}});
    shape.attributes.group.assign(shape.mesh.face_count(), 0);
    shape.attributes.groups.push_back({.mesh = m});
  }
  Shape all = joined(std::move(shapes));
  model.mesh = std::move(all.mesh);
  model.attributes = std::move(all.attributes);
  scene::Scene scene;
  scene.nodes.resize(2);
  scene.order = {0, 1};
  for (std::uint32_t m = 0; m < 2; ++m) {
    scene.nodes[m].mesh = m;
    scene.meshes.push_back({.has_faces = true, .placements = {{.node = m}}});
  }
  model.scene = std::make_shared<const scene::Scene>(std::move(scene));
  return model;
}

class ChosenMeshTest : public testing::Test {
 protected:
  ChosenMeshTest() { show_model(session_, two_grids(), "two.gltf"); }
  std::vector<std::uint32_t> faces() const {
    return face_counts(session_.document.model.attributes, 2);
  }
  Session session_;
};

TEST_F(ChosenMeshTest, EditsApplyToTheChosenMeshOnly) {
  press(session_, "d");
  const std::vector<std::uint32_t> both = faces();
  EXPECT_LE(both[0] + both[1], 360U);
  press(session_, "ctrl+z");
  choose_mesh(session_.document, 1);
  press(session_, "d");
  EXPECT_EQ(faces()[0], 200U);
  EXPECT_LE(faces()[1], 180U);
  press(session_, "ctrl+z s");
  EXPECT_EQ(faces(), (std::vector<std::uint32_t>{200, 800}));
  press(session_, "s");
  EXPECT_EQ(faces(), (std::vector<std::uint32_t>{200, 3200}));
  press(session_, "shift+s shift+s");
  EXPECT_EQ(faces(), (std::vector<std::uint32_t>{200, 200}));
}

TEST_F(ChosenMeshTest, ATargetCountsTheFacesOfAllMeshes) {
  choose_mesh(session_.document, 0);
  request_simplify_to(session_.document, 300);
  run_waiting_edits(session_.document);
  EXPECT_LE(faces()[0], 100U);
  EXPECT_EQ(faces()[1], 200U);
}

TEST_F(ChosenMeshTest, EditsAsTextNameTheirMesh) {
  choose_mesh(session_.document, 1);
  press(session_, "d s");
  const Mesh edited = session_.document.model.mesh;
  const std::vector<HistoryStep> steps = session_.document.edits.history.steps();
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_TRUE(steps[0].text.ends_with(" mesh=1")) << steps[0].text;
  show_model(session_, two_grids(), "two.gltf");
  for (const HistoryStep& step : steps) {
    request(session_.document.edits, edit_from_text(step.text, session_.document));
    run_waiting_edits(session_.document);
  }
  EXPECT_TRUE(is_same(session_.document.model.mesh, edited));
}

TEST_F(ChosenMeshTest, AMeshThatIsNotThereIsRefused) {
  request(session_.document.edits, edit_from_text("simplify mesh=7", session_.document));
  run_waiting_edits(session_.document);
  EXPECT_EQ(session_.document.notice, "there is no such mesh");
  EXPECT_EQ(session_.document.edits.history.undo_depth(), 0U);
}

}  // namespace
}  // namespace mesher::app
