#include "engine/io/gltf_model.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/core/error.h"
#include "engine/io/gltf_scene.h"
#include "engine/scene/placed.h"
#include "tests/support/gltf_scene_file.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using test::TempFolder;

Model read_scene_model(const std::filesystem::path& file) {
  return read_model(file, {.keeps_scene = true});
}

std::vector<std::string> write(const std::filesystem::path& to, const Model& model) {
  AtomicFile file(to);
  const auto losses =
      write_gltf_model(file, {model.mesh, model.attributes}, *model.scene, false, nullptr);
  file.commit();
  return losses;
}

nlohmann::json parsed(const std::filesystem::path& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in);
}

/// The file with a part of its text replaced.
std::string scene_file_with(const std::string& before, const std::string& after) {
  std::string text = test::scene_file();
  return text.replace(text.find(before), before.size(), after);
}

TEST(GltfModel, HoldsEachMeshOnceWhereTheSceneShowsItFirst) {
  const TempFolder folder;
  const Model model = read_scene_model(folder.write("s.gltf", test::scene_file()));
  test::expect_valid(model.mesh);
  EXPECT_EQ(model.mesh.face_count(), 4U);
  ASSERT_NE(model.scene, nullptr);
  EXPECT_EQ(model.scene->meshes.size(), 2U);
  EXPECT_FALSE(model.scene->meshes[1].has_faces);
  EXPECT_EQ(model.scene->nodes[2].depth, 2U);
  EXPECT_EQ(bounding_box(model.mesh).max, glm::vec3(14, 2, 0));  // of "a", twice as large
  EXPECT_EQ(model.attributes.groups[0].object, "a");
  EXPECT_EQ(model.scene->animations.size(), 1U);
  // What it shows is what reading without the scene gives.
  const Model baked = read_model(folder.path() / "s.gltf");
  const Shape shown = scene::placed(model.mesh, model.attributes, *model.scene);
  EXPECT_EQ(shown.mesh.face_count(), baked.mesh.face_count());
  EXPECT_TRUE(std::ranges::equal(shown.mesh.positions(), baked.mesh.positions()));
}

TEST(GltfModel, UneditedMeshesAreWrittenAsTheyWere) {
  const TempFolder folder;
  const Model model = read_scene_model(folder.write("s.gltf", test::scene_file()));
  EXPECT_TRUE(write(folder.path() / "o.gltf", model).empty());
  const Model again = read_scene_model(folder.path() / "o.gltf");
  EXPECT_TRUE(test::is_identical(again.mesh, model.mesh));
  EXPECT_EQ(parsed(folder.path() / "o.gltf")["meshes"], parsed(folder.path() / "s.gltf")["meshes"]);
}

TEST(GltfModel, EditedMeshesGoBackToTheirOwnCoordinates) {
  const TempFolder folder;
  Model model = read_scene_model(folder.write("s.gltf", test::scene_file()));
  const glm::vec3 before = model.mesh.position(Vertex(0));
  model.mesh.set_position(Vertex(0), before + glm::vec3(0.0F, 0.0F, 2.0F));
  write(folder.path() / "o.gltf", model);
  const nlohmann::json file = parsed(folder.path() / "o.gltf");
  EXPECT_EQ(file["nodes"], parsed(folder.path() / "s.gltf")["nodes"]);
  EXPECT_EQ(file["animations"].size(), 1U);
  EXPECT_EQ(file["extensions"]["VENDOR_rig"]["curve"], 5);
  // Node "a" doubles the mesh, and "b" does not.
  const Model baked = read_model(folder.path() / "o.gltf");
  EXPECT_EQ(bounding_box(baked.mesh).max.z, 2.0F);
  GltfScene document(folder.path() / "o.gltf");
  EXPECT_EQ(bounding_box(document.read_meshes()[0].model.mesh).max.z, 1.0F);
}

TEST(GltfModel, MirroredMeshesAreTurnedAndTurnedBack) {
  const std::string text = scene_file_with(R"("scale":[2,2,2])", R"("scale":[-2,2,2])");
  const TempFolder folder;
  Model model = read_scene_model(folder.write("s.gltf", text));
  test::expect_valid(model.mesh);
  const Model baked = read_model(folder.path() / "s.gltf");
  // Both see the front of the sheet.
  const auto up = [](const Mesh& mesh) {
    const auto at = [&](std::uint32_t c) { return mesh.position(mesh.origin(Halfedge(c))); };
    return glm::cross(at(1) - at(0), at(2) - at(0)).z;
  };
  EXPECT_GT(up(baked.mesh), 0.0F);
  EXPECT_GT(up(model.mesh), 0.0F);
  model.mesh.set_position(Vertex(0), model.mesh.position(Vertex(0)) + glm::vec3(0, 0, 2));
  write(folder.path() / "o.gltf", model);
  GltfScene document(folder.path() / "o.gltf");
  EXPECT_GT(up(document.read_meshes()[0].model.mesh), 0.0F);
  EXPECT_EQ(parsed(folder.path() / "o.gltf")["nodes"], parsed(folder.path() / "s.gltf")["nodes"]);
}

TEST(GltfModel, KeepsDigitsFarFromTheOrigin) {
  const std::string text =
      scene_file_with(R"("translation":[10,0,0])", R"("translation":[4500000.25,600000.5,0])");
  const TempFolder folder;
  const Model model = read_scene_model(folder.write("s.gltf", text));
  const Box box = bounding_box(model.mesh);
  EXPECT_EQ(double(box.min.x) + model.origin.x, 4500000.25);
  EXPECT_EQ(double(box.max.x) + model.origin.x, 4500004.25);
  EXPECT_EQ(double(box.max.y) + model.origin.y, 600002.5);
  EXPECT_TRUE(write(folder.path() / "o.gltf", model).empty());
  EXPECT_EQ(parsed(folder.path() / "o.gltf")["meshes"], parsed(folder.path() / "s.gltf")["meshes"]);
}

// A layer of one mesh is laid out for all, and must not get into the file of the others.
TEST(GltfModel, AttributesOfOneMeshDoNotTouchTheOthers) {
  test::GltfDocument document;
  document.floats(test::kSquareCorners, "VEC3", 3);  // 0
  document.indices(test::kSquareIndices);            // 1
  const std::string joints(16, '\1');
  document.accessor(R"("bufferView":)" + std::to_string(document.view(joints)), 5121, "VEC4", 4);
  const std::string colors(16, '\x40');
  document.accessor(R"("normalized":true,"bufferView":)" + std::to_string(document.view(colors)),
                    5121, "VEC4", 4);
  const TempFolder folder;
  const auto file = folder.write("s.gltf", document.text(R"("nodes":[{"mesh":0},{"mesh":1}],
    "meshes":[{"primitives":[{"indices":1,"attributes":{"POSITION":0,"_BONES":2,"COLOR_0":3}}]},
      {"primitives":[{"indices":1,"attributes":{"POSITION":0}}]}])"));
  Model model = read_scene_model(file);
  EXPECT_TRUE(write(folder.path() / "o.gltf", model).empty());
  EXPECT_EQ(parsed(folder.path() / "o.gltf")["meshes"], parsed(file)["meshes"]);
  model.mesh.set_position(Vertex(5), glm::vec3(0.0F, 0.0F, 3.0F));  // of the second mesh
  write(folder.path() / "o.gltf", model);
  const nlohmann::json edited = parsed(folder.path() / "o.gltf")["meshes"];
  EXPECT_EQ(edited[0], parsed(file)["meshes"][0]);
  EXPECT_EQ(edited[1]["primitives"][0]["attributes"].size(), 1U);
}

TEST(GltfModel, AScenesMeshesWithoutPlaceAreShownWhereTheyAre) {
  const std::string text = scene_file_with(R"("nodes":[0]}])", R"("nodes":[4]}])");
  const TempFolder folder;
  const Model model = read_scene_model(folder.write("s.gltf", text));
  EXPECT_EQ(model.mesh.face_count(), 4U);
  EXPECT_EQ(bounding_box(model.mesh).max, glm::vec3(2, 1, 0));
  EXPECT_FALSE(scene::differs_from_model(*model.scene));
}

TEST(GltfModel, TooManyInstancesAreShownOnceAndWrittenAsTheyWere) {
  test::GltfDocument document;
  document.floats(test::kSquareCorners, "VEC3", 3);                   // 0
  document.indices(test::kSquareIndices);                             // 1
  document.floats(std::vector<float>(3 * 200'000, 1.0F), "VEC3", 3);  // 2
  const TempFolder folder;
  const auto file = folder.write(
      "s.gltf",
      document.text(R"("extensionsUsed":["EXT_mesh_gpu_instancing"],"nodes":[{"mesh":0,"extensions":
        {"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":2}}}}],
        "meshes":[{"primitives":[{"indices":1,"attributes":{"POSITION":0}}]}])"));
  const Model model = read_scene_model(file);
  EXPECT_EQ(model.scene->meshes[0].placements.size(), 1U);
  ASSERT_EQ(model.contents.warnings().size(), 1U);
  EXPECT_TRUE(write(folder.path() / "o.gltf", model).empty());
  EXPECT_EQ(parsed(folder.path() / "o.gltf")["nodes"], parsed(file)["nodes"]);
}

TEST(GltfModel, AFileThatChangesLaterDoesNoHarm) {
  const TempFolder folder;
  const auto file = folder.write("s.gltf", test::scene_file());
  const Model model = read_scene_model(file);
  const nlohmann::json before = parsed(file);
  std::filesystem::resize_file(file, 10);
  EXPECT_TRUE(write(folder.path() / "o.gltf", model).empty());
  EXPECT_EQ(parsed(folder.path() / "o.gltf")["meshes"], before["meshes"]);
}

TEST(GltfModel, FilesWithoutTrianglesAreRefused) {
  const TempFolder folder;
  EXPECT_THROW(read_scene_model(folder.write("s.gltf", R"({"asset":{"version":"2.0"}})")),
               InputError);
}

TEST(GltfModel, BrokenAnimationsAreNamedAndTheShapeOpens) {
  const std::string text = scene_file_with(R"("output":5)", R"("output":77)");
  const TempFolder folder;
  const Model model = read_scene_model(folder.write("s.gltf", text));
  EXPECT_EQ(model.mesh.face_count(), 4U);
  EXPECT_TRUE(model.scene->animations.empty());
  ASSERT_EQ(model.contents.warnings().size(), 1U);
  EXPECT_TRUE(model.contents.warnings()[0].starts_with("animations cannot be played"));
}

}  // namespace
}  // namespace mesher::io
