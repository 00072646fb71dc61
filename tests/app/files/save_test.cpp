#include "app/files/save.h"

#include <gtest/gtest.h>

#include "app/document/session.h"
#include "app/edit/edits.h"
#include "app/files/leave.h"
#include "app/input/commands.h"
#include "engine/core/error.h"
#include "engine/io/read.h"
#include "engine/mesh/delta.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

class SaveTest : public testing::Test {
 protected:
  SaveTest() { show(test::cube(), "cube.ply"); }
  void show(Soup soup, const char* name) {
    Model model;
    model.mesh = build_mesh(std::move(soup)).mesh;
    show_model(s_, std::move(model), folder_ / name);
  }
  void submit(const std::filesystem::path& file) {
    s_.saving.typed = file.string();
    submit_save(s_.saving, s_.document);
  }
  void save(const std::filesystem::path& file) {
    run(s_, "save_file");
    submit(file);
    run_waiting_save(s_);
  }

  test::TempFolder folder_;
  Session s_;
};

TEST_F(SaveTest, SuggestsNewNameInFolderOfOpenedFile) {
  run(s_, "save_file");
  EXPECT_TRUE(s_.saving.shows_dialog);
  EXPECT_EQ(s_.saving.typed, (folder_ / "cube-edited.ply").string());
  run(s_, "tag_creases");
  run_waiting_edits(s_.document);
  run(s_, "save_file");
  EXPECT_EQ(s_.saving.typed, (folder_ / "cube-edited.obj").string()) << "PLY cannot hold creases";
  folder_.write("cube-edited.obj", "somebody's");
  run(s_, "save_file");
  EXPECT_EQ(s_.saving.typed, (folder_ / "cube-edited-2.obj").string());
  run(s_, "escape");
  EXPECT_FALSE(s_.saving.shows_dialog);
  EXPECT_FALSE(s_.wants_quit);
}

TEST_F(SaveTest, SavedFileRestoresEverySharpness) {
  Mesh& mesh = s_.document.model.mesh;
  const float values[] = {0.5F, 1.0F / 3.0F, 10.0F, kInfinitelySharp};
  std::uint32_t vertex = 0;
  for (const float value : values) {
    mesh.set_sharpness(mesh.edge(Mesh::halfedge(Face(2 * vertex), 0)), value);
    mesh.set_sharpness(Vertex(vertex++), value);
  }
  save(folder_ / "out.obj");
  EXPECT_FALSE(s_.saving.shows_dialog);
  EXPECT_EQ(s_.document.notice, "saved " + (folder_ / "out.obj").string() + ": 12 faces");
  const Model back = io::read_model(folder_ / "out.obj");
  EXPECT_TRUE(difference(mesh, back.mesh).is_empty());
  EXPECT_TRUE(back.report.is_clean());
}

TEST_F(SaveTest, ReportsWhatFormatCannotHold) {
  run(s_, "tag_creases");
  run_waiting_edits(s_.document);
  save(folder_ / "out.stl");
  EXPECT_NE(s_.document.notice.find("; the format cannot hold 12 creases"), std::string::npos)
      << s_.document.notice;
}

TEST_F(SaveTest, OverwritesOnlyAfterConfirmation) {
  const auto file = folder_.write("mine.obj", "mine");
  const auto other = folder_.write("other.obj", "other");
  run(s_, "save_file");
  submit(file);
  EXPECT_TRUE(s_.saving.shows_dialog);
  EXPECT_EQ(s_.saving.remark, "mine.obj already exists; press Enter again to overwrite it");
  EXPECT_FALSE(s_.saving.waiting);
  submit(other);
  EXPECT_EQ(s_.saving.remark, "other.obj already exists; press Enter again to overwrite it");
  submit(file);
  EXPECT_FALSE(s_.saving.waiting) << "another name was submitted since";
  EXPECT_EQ(test::read_bytes(file), "mine");
  submit(file);
  ASSERT_TRUE(s_.saving.waiting);
  run_waiting_save(s_);
  EXPECT_EQ(io::read_model(file).mesh.face_count(), 12U);
  EXPECT_EQ(test::read_bytes(other), "other");
  run(s_, "save_file");
  submit(file);
  EXPECT_FALSE(s_.saving.waiting) << "the next save asks again";
}

TEST_F(SaveTest, InvalidNamesAreRejected) {
  run(s_, "save_file");
  submit(folder_ / "cube.xyz");
  EXPECT_EQ(s_.saving.remark, "the name must end in obj, ply, stl, off, gltf or glb");
  submit("  ");
  EXPECT_EQ(s_.saving.remark, "enter a file name");
  EXPECT_TRUE(s_.saving.shows_dialog);
  submit(folder_ / "no such folder" / "cube.obj");
  EXPECT_THROW(run_waiting_save(s_), OutputError);
  EXPECT_FALSE(s_.saving.waiting);
  show({}, "empty.obj");
  run(s_, "save_file");
  submit(folder_ / "empty2.obj");
  EXPECT_EQ(s_.saving.remark, "there is nothing to save");
}

TEST_F(SaveTest, OpeningDialogClosesOther) {
  run(s_, "open_file");
  run(s_, "save_file");
  EXPECT_FALSE(s_.shows_open_dialog);
  run(s_, "open_file");
  EXPECT_FALSE(s_.saving.shows_dialog);
}

}  // namespace
}  // namespace mesher::app
