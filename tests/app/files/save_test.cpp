#include "app/files/save.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/document/session.h"
#include "app/edit/edits.h"
#include "app/files/browse.h"
#include "app/files/leave.h"
#include "app/input/commands.h"
#include "engine/core/error.h"
#include "engine/io/pm_file.h"
#include "engine/io/read.h"
#include "engine/mesh/corner_attributes.h"
#include "engine/mesh/delta.h"
#include "tests/support/gltf_scene_file.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"
#include "tests/support/watched.h"

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
    set_text(s_.saving.browser, file.string());
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
  EXPECT_EQ(s_.saving.browser.typed, "cube-edited.ply");
  EXPECT_EQ(typed_file(s_.saving.browser), folder_ / "cube-edited.ply");
  run(s_, "tag_creases");
  run_waiting_edits(s_.document);
  run(s_, "save_file");
  EXPECT_EQ(s_.saving.browser.typed, "cube-edited.obj") << "PLY cannot hold creases";
  folder_.write("cube-edited.obj", "somebody's");
  run(s_, "save_file");
  EXPECT_EQ(s_.saving.browser.typed, "cube-edited-2.obj");
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

TEST_F(SaveTest, MaterialsAreSavedBesideTheModel) {
  Model& model = s_.document.model;
  model.materials = std::make_shared<const Materials>(Materials{.materials = {{.name = "paint"}}});
  model.contents.add(Content::materials, "paint");
  model.attributes.group.assign(model.mesh.face_count(), 0);
  model.attributes.groups = {{.material = 0}};
  save(folder_ / "out.obj");
  EXPECT_EQ(s_.document.notice, "saved " + (folder_ / "out.obj").string() + ": 12 faces");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out.mtl"));
  const Model back = io::read_model(folder_ / "out.obj");
  EXPECT_EQ(back.materials->materials.at(0).name, "paint");
  EXPECT_EQ(back.attributes.groups, model.attributes.groups);
  save(folder_ / "out.ply");
  EXPECT_NE(s_.document.notice.find("1 material: paint"), std::string::npos);
}

TEST_F(SaveTest, ReportsWhatFormatCannotHold) {
  run(s_, "tag_creases");
  run_waiting_edits(s_.document);
  save(folder_ / "out.stl");
  EXPECT_NE(s_.document.notice.find("; it does not hold 12 creases"), std::string::npos)
      << s_.document.notice;
}

TEST_F(SaveTest, OverwritesOnlyAfterConfirmation) {
  const auto file = folder_.write("mine.obj", "mine");
  const auto other = folder_.write("other.obj", "other");
  run(s_, "save_file");
  submit(file);
  EXPECT_TRUE(s_.saving.shows_dialog);
  EXPECT_EQ(s_.saving.browser.problem,
            "mine.obj already exists; press Enter again to overwrite it");
  EXPECT_FALSE(s_.saving.waiting);
  submit(other);
  EXPECT_EQ(s_.saving.browser.problem,
            "other.obj already exists; press Enter again to overwrite it");
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
  EXPECT_EQ(s_.saving.browser.problem, "the name must end in obj, ply, stl, off, gltf, glb or pm");
  submit("  ");
  EXPECT_EQ(s_.saving.browser.problem, "enter a file name");
  EXPECT_TRUE(s_.saving.shows_dialog);
  submit(folder_ / "no such folder" / "cube.obj");
  EXPECT_EQ(s_.saving.browser.problem,
            "there is no folder " + (folder_ / "no such folder").string());
  s_.saving.waiting = folder_ / "no such folder" / "cube.obj";
  EXPECT_THROW(run_waiting_save(s_), OutputError);
  EXPECT_FALSE(s_.saving.waiting);
  show({}, "empty.obj");
  run(s_, "save_file");
  submit(folder_ / "empty2.obj");
  EXPECT_EQ(s_.saving.browser.problem, "there is nothing to save");
}

TEST_F(SaveTest, FolderIsEnteredAndARowIsChosen) {
  std::filesystem::create_directory(folder_ / "below");
  folder_.write("other.ply", "");
  run(s_, "save_file");
  submit(folder_ / "below");
  EXPECT_TRUE(s_.saving.shows_dialog);
  EXPECT_EQ(s_.saving.browser.folder, folder_ / "below");
  submit(folder_ / "");
  const Folder folder = read_folder(folder_.path());
  const auto shown = shown_entries(folder, {});
  ASSERT_EQ(shown.size(), 2U);
  move_row(s_.saving.browser, 2, shown.size());
  submit_save(s_.saving, s_.document, shown);
  EXPECT_EQ(s_.saving.browser.typed, "other.ply");
  EXPECT_EQ(s_.saving.browser.problem,
            "other.ply already exists; press Enter again to overwrite it");
}

TEST_F(SaveTest, FolderAndFormatAreRemembered) {
  std::filesystem::create_directory(folder_ / "below");
  save(folder_ / "below" / "first.stl");
  run(s_, "save_file");
  EXPECT_EQ(typed_file(s_.saving.browser), folder_ / "below" / "cube-edited.stl");
  run(s_, "tag_creases");
  run_waiting_edits(s_.document);
  run(s_, "save_file");
  EXPECT_EQ(s_.saving.browser.typed, "cube-edited.obj") << "STL cannot hold creases";
  std::filesystem::remove_all(folder_ / "below");
  run(s_, "save_file");
  EXPECT_EQ(s_.saving.browser.folder, folder_.path());
}

TEST_F(SaveTest, ChoosingAFormatChangesTheEnding) {
  run(s_, "save_file");
  for (const std::string& extension : saved_extensions()) {
    choose_format(s_.saving, extension);
    EXPECT_EQ(s_.saving.browser.typed, "cube-edited" + extension);
  }
  set_text(s_.saving.browser, "scan 2.1");
  choose_format(s_.saving, ".glb");
  EXPECT_EQ(s_.saving.browser.typed, "scan 2.1.glb");
}

TEST_F(SaveTest, FormatsSayWhatTheyLose) {
  run(s_, "tag_creases");
  run_waiting_edits(s_.document);
  EXPECT_EQ(always_lost(s_.document, ".stl"), std::vector<std::string>{"creases"});
  EXPECT_EQ(always_lost(s_.document, ".obj"), std::vector<std::string>{});
  EXPECT_EQ(always_lost(s_.document, ".pm"), std::vector<std::string>{});
  EXPECT_EQ(losses_of(s_.document, "x.stl"), std::vector<std::string>{"12 creases"});
  EXPECT_EQ(losses_of(s_.document, "x.pm"), std::vector<std::string>{});
  CornerAttributes corners;
  corners.color.assign(36, glm::u8vec4(1));
  s_.document.model.attributes = to_wedges(s_.document.model.mesh, std::move(corners));
  EXPECT_EQ(always_lost(s_.document, ".pm"), std::vector<std::string>{});
  EXPECT_EQ(losses_of(s_.document, "x.pm"), std::vector<std::string>{});
  EXPECT_EQ(always_lost(s_.document, ".off"), (std::vector<std::string>{"creases"}));
}

TEST_F(SaveTest, ProgressiveMeshKeepsAttributes) {
  show(test::torus(30, 20), "torus.ply");
  const Mesh& mesh = s_.document.model.mesh;
  CornerAttributes corners;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const glm::vec3& p = mesh.position(mesh.origin(Halfedge(h)));
    corners.texcoord.push_back({0.25F * p.x + (h < 1800 ? 0.0F : 2.0F), 0.25F * p.y});
  }
  s_.document.model.attributes = to_wedges(mesh, std::move(corners));
  save(folder_ / "built.pm");
  run(s_, "toggle_progressive");
  run_waiting_edits(s_.document);
  run(s_, "least_detail");
  save(folder_ / "taken.pm");
  EXPECT_EQ(test::read_bytes(folder_ / "taken.pm"), test::read_bytes(folder_ / "built.pm"));
  const io::PmContents read = io::read_pm_file(folder_ / "built.pm");
  const Attributes attributes = read.attributes.at_level(read.mesh.mesh());
  const Array<glm::vec2> uv = to_corners(read.mesh.mesh(), attributes).texcoord;
  ASSERT_EQ(uv.size(), read.mesh.mesh().halfedge_count());
  for (std::uint32_t h = 0; h < uv.size(); ++h) {
    const glm::vec3& p = read.mesh.mesh().position(read.mesh.mesh().origin(Halfedge(h)));
    EXPECT_EQ(uv[h].y, 0.25F * p.y);
  }
}

TEST_F(SaveTest, ProgressiveMeshIsBuiltOrTaken) {
  show(test::torus(30, 20), "torus.ply");
  save(folder_ / "built.pm");
  const io::PmContents built = io::read_pm_file(folder_ / "built.pm");
  EXPECT_EQ(built.summary.faces, 1200U);
  EXPECT_LT(built.summary.base_faces, 1200U);
  run(s_, "toggle_progressive");
  run_waiting_edits(s_.document);
  run(s_, "least_detail");
  save(folder_ / "taken.pm");
  EXPECT_EQ(test::read_bytes(folder_ / "taken.pm"), test::read_bytes(folder_ / "built.pm"))
      << "a .pm file holds all levels, whichever is shown";
  EXPECT_EQ(s_.document.progressive.position(), 0.0) << "the shown level stays";
}

TEST_F(SaveTest, CanceledProgressiveMeshLeavesNoFile) {
  s_.saving.waiting = folder_ / "none.pm";
  const auto task = begin_save(s_.saving, s_.document);
  Progress progress;
  progress.cancel();
  EXPECT_THROW(perform(*task, &progress), Cancelled);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none.pm"));
}

TEST_F(SaveTest, OpeningDialogClosesOther) {
  run(s_, "open_file");
  run(s_, "save_file");
  EXPECT_FALSE(s_.open_dialog.is_shown);
  run(s_, "open_file");
  EXPECT_FALSE(s_.saving.shows_dialog);
}

TEST_F(SaveTest, HasOneProgressForEveryFormat) {
  show(test::torus(600, 400), "torus.ply");
  for (const char* name : {"t.obj", "t.ply", "t.stl", "t.off", "t.gltf", "t.glb"}) {
    SCOPED_TRACE(name);
    s_.saving.waiting = folder_ / name;
    const auto task = begin_save(s_.saving, s_.document);
    test::expect_one_progress(
        test::watched([&](Progress* progress) { (void)perform(*task, progress); }), {"writing"});
  }
  s_.saving.waiting = folder_ / "t.pm";
  const auto task = begin_save(s_.saving, s_.document);
  test::expect_one_progress(
      test::watched([&](Progress* progress) { (void)perform(*task, progress); }),
      {"simplifying", "preparing", "simplifying", "finishing", "recording", "writing", "coding"});
}

TEST_F(SaveTest, ScenesAreKeptAndWhatTheyCannotHoldIsNamed) {
  const auto open = [&] {
    show_model(s_,
               io::read_model(folder_.write("s.gltf", test::scene_file()), {.keeps_scene = true}),
               folder_ / "s.gltf");
  };
  const auto save = [&](const char* name) {
    s_.saving.waiting = folder_ / name;
    return perform(*begin_save(s_.saving, s_.document));
  };
  open();
  EXPECT_TRUE(save("o.glb").losses.empty());
  EXPECT_EQ(save("o.obj").faces, 8U) << "the sheet is shown twice";
  const auto pm = save("o.pm").losses;
  EXPECT_NE(std::ranges::find(pm, "places and poses of the scene's meshes"), pm.end());
  Mesh& mesh = s_.document.model.mesh;
  mesh.set_sharpness(mesh.edge(Halfedge(0)), 2.0F);
  s_.document.statistics.crease_edges = 1;
  EXPECT_EQ(always_lost(s_.document, ".glb"), std::vector<std::string>{"creases"});
  EXPECT_EQ(save("o.glb").losses, std::vector<std::string>{"creases"});
  open();
}

TEST_F(SaveTest, CanceledSaveLeavesTheOldFile) {
  show(test::torus(test::kSanitized ? 140 : 700, 500), "torus.ply");
  for (const char* name : {"t.obj", "t.ply", "t.stl", "t.off", "t.glb", "t.pm"}) {
    const auto file = folder_.write(name, "the old one");
    s_.saving.waiting = file;
    const auto task = begin_save(s_.saving, s_.document);
    const auto save = [&](Progress* progress) {
      (void)perform(*task, progress);
      folder_.write(name, "the old one");
    };
    test::cancel_at_many_moments(std::string("saving ") + name, save,
                                 [&] { EXPECT_EQ(test::read_bytes(file), "the old one"); });
  }
}

}  // namespace
}  // namespace mesher::app
