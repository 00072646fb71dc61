#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/core/error.h"
#include "engine/io/losses.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

namespace fs = std::filesystem;
using test::read_bytes;
using test::TempFolder;

const std::string kPng = "\x89PNG\r\n\x1A\nsome";
const std::string kOtherPng = "\x89PNG\r\n\x1A\nother";
const std::string kMtl =
    "newmtl Red Paint\nKd 1 0 0\nmap_Kd tex/test texture.png\n\nnewmtl Blue Paint (2)\nKd 0 0 1\n"
    "Ks 1 1 1\n";

/// Two materials, an object, groups and smoothing groups.
Model two_materials(const TempFolder& folder) {
  fs::create_directory(folder / "tex");
  folder.write("tex/test texture.png", kPng);
  folder.write("in.mtl", kMtl);
  return read_model(folder.write(
      "in.obj",
      "mtllib in.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
      "o Box\ng part 0\nusemtl Red Paint\ns off\nf 1/1 2/2 3/3\n"
      "g part 1\nusemtl Blue Paint (2)\ns 1\nf 1/1 3/3 4/4\n"));
}

std::vector<std::string> write(const fs::path& file, const Model& model) {
  write_model(file, model.mesh, model.attributes,
              {.origin = model.origin, .materials = model.materials});
  return losses_in_format(file, model.mesh, model.attributes, model.materials.get(), model.contents,
                          model.origin);
}

TEST(MaterialsWrite, ObjKeepsEverything) {
  const TempFolder folder;
  const Model model = two_materials(folder);
  fs::create_directory(folder / "out");
  EXPECT_TRUE(write(folder / "out/o.obj", model).empty());
  EXPECT_EQ(read_bytes(folder / "out/o.mtl"), "# mesher: materials\n\n" + kMtl);
  EXPECT_EQ(read_bytes(folder / "out/tex/test texture.png"), kPng);
  const Model back = read_model(folder / "out/o.obj");
  EXPECT_EQ(back.attributes.groups, model.attributes.groups);
  EXPECT_EQ(back.materials->materials[0].mtl_statements,
            model.materials->materials[0].mtl_statements);
  EXPECT_TRUE(back.contents.warnings().empty());
}

TEST(MaterialsWrite, ExistingFilesAreNotOverwritten) {
  const TempFolder folder;
  const Model model = two_materials(folder);
  fs::create_directories(folder / "out/tex");
  folder.write("out/tex/test texture.png", kOtherPng);
  folder.write("out/o.mtl", "newmtl of another\n");
  write(folder / "out/o.obj", model);
  EXPECT_EQ(read_bytes(folder / "out/tex/test texture.png"), kOtherPng);
  EXPECT_EQ(read_bytes(folder / "out/tex/test texture-2.png"), kPng);
  EXPECT_EQ(read_bytes(folder / "out/o.mtl"), "newmtl of another\n");
  const std::string mtl = read_bytes(folder / "out/o-2.mtl");
  EXPECT_NE(mtl.find("map_Kd tex/test texture-2.png\n"), std::string::npos);
  EXPECT_NE(read_bytes(folder / "out/o.obj").find("mtllib o-2.mtl\n"), std::string::npos);
  // Again: the same files.
  write(folder / "out/o.obj", read_model(folder / "out/o.obj"));
  EXPECT_EQ(read_bytes(folder / "out/tex/test texture-2.png"), kPng);
  EXPECT_FALSE(fs::exists(folder / "out/tex/test texture-3.png"));
}

TEST(MaterialsWrite, AFailedWriteLeavesNothing) {
  const TempFolder folder;
  const Model model = two_materials(folder);
  fs::create_directory(folder / "out");
  Progress progress;
  progress.cancel();
  EXPECT_THROW(write_model(folder / "out/o.obj", model.mesh, model.attributes,
                           {.materials = model.materials, .progress = &progress}),
               Cancelled);
  EXPECT_TRUE(fs::is_empty(folder / "out"));
  folder.write("out/tex", "a file in place of the folder");
  EXPECT_THROW(write(folder / "out/o.obj", model), OutputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "out"), fs::directory_iterator()), 1);
}

TEST(MaterialsWrite, MissingFilesAreReferredToAgain) {
  const TempFolder folder;
  const Model model = read_model(folder.write(
      "in.obj",
      "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng outside\nusemtl brick\nf 1 2 3 4\n"
      "g inside\nusemtl paper\nf 4 3 2 1\n"));
  EXPECT_EQ(model.mesh.face_count(), 4U);
  EXPECT_TRUE(write(folder / "o.obj", model).empty());
  EXPECT_FALSE(fs::exists(folder / "o.mtl"));
  const std::string text = read_bytes(folder / "o.obj");
  for (const char* line : {"mtllib t.mtl\n", "usemtl brick\n", "usemtl paper\n", "g inside\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line;
}

nlohmann::json json_of(const fs::path& file) {
  return nlohmann::json::parse(read_bytes(file));
}

TEST(MaterialsWrite, GltfHasAPrimitivePerMaterial) {
  const TempFolder folder;
  const Model model = two_materials(folder);
  const std::vector<std::string> lost = write(folder / "o.gltf", model);
  EXPECT_EQ(lost,
            (std::vector<std::string>{"2 groups: part 0, part 1", "1 object: Box",
                                      "1 smoothing group: 1", "specular color of 1 material"}));
  const nlohmann::json json = json_of(folder / "o.gltf");
  const auto& primitives = json["meshes"][0]["primitives"];
  ASSERT_EQ(primitives.size(), 2U);
  EXPECT_EQ(primitives[0]["attributes"], primitives[1]["attributes"]);
  EXPECT_NE(primitives[0]["indices"], primitives[1]["indices"]);
  EXPECT_EQ(primitives[1]["material"], 1);
  EXPECT_EQ(json["images"][0]["mimeType"], "image/png");
  const Model back = read_model(folder / "o.gltf");
  ASSERT_EQ(back.materials->materials.size(), 2U);
  EXPECT_EQ(back.materials->materials[1].name, "Blue Paint (2)");
  EXPECT_EQ(*back.materials->images[0].bytes, kPng);
  EXPECT_EQ(back.attributes.groups[1].material, 1U);
}

TEST(MaterialsWrite, TermsOfGltfComeBackFromGlbAndObj) {
  const TempFolder folder;
  Model model = two_materials(folder);
  Materials look{.materials = {{.name = "a"}, {.name = "a"}}, .images = {{.name = "x/y"}}};
  Material& first = look.materials[0];
  look.images[0].bytes = std::make_shared<const std::string>(kPng);
  look.images[0].mime_type = "image/png";
  look.texture_count = 1;
  first.base_color = {0.5F, 0.25F, 1.0F, 0.5F};
  first.alpha = AlphaMode::blend;
  first.metallic = 0.25F;
  first.roughness = 0.75F;
  first.emission = {2.0F, 1.0F, 0.0F};
  first.is_unlit = true;
  first.base_color_texture = {.image = 0, .offset = {0.5F, 0.25F}, .scale = {2.0F, 3.0F}};
  first.normal_texture = {.image = 0, .strength = 0.5F};
  model.materials = std::make_shared<const Materials>(look);
  model.contents = {};
  for (const char* name : {"o.glb", "o.obj"}) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(write(folder / name, model).size() <= 3U);
    const Model back = read_model(folder / name);
    const Material& m = back.materials->materials.at(0);
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(m.base_color[i], first.base_color[i], 1e-5F);
    EXPECT_NEAR(m.emission.r, 2.0F, 1e-4F);
    EXPECT_EQ(m.alpha, AlphaMode::blend);
    EXPECT_EQ(m.metallic, 0.25F);
    EXPECT_EQ(m.roughness, 0.75F);
    EXPECT_TRUE(m.is_unlit);
    EXPECT_EQ(m.base_color_texture.scale, first.base_color_texture.scale);
    EXPECT_EQ(m.base_color_texture.offset, first.base_color_texture.offset);
    EXPECT_EQ(m.normal_texture.strength, 0.5F);
    EXPECT_EQ(*back.materials->images.at(0).bytes, kPng);
  }
  EXPECT_EQ(read_model(folder / "o.obj").materials->materials.at(1).name, "a-2");
  EXPECT_TRUE(fs::exists(folder / "x_y.png"));
}

TEST(MaterialsWrite, GltfHasNoTexturesWithoutCoordinates) {
  const TempFolder folder;
  folder.write("a.png", kPng);
  folder.write("in.mtl", "newmtl a\nmap_Kd a.png\n");
  const Model model = read_model(
      folder.write("in.obj", "mtllib in.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"));
  EXPECT_EQ(write(folder / "o.gltf", model),
            std::vector<std::string>{"1 texture without texture coordinates"});
  EXPECT_FALSE(json_of(folder / "o.gltf").contains("textures"));
}

TEST(MaterialsWrite, NamesOutsideOfUtf8AreWrittenToJson) {
  const TempFolder folder;
  const Model model =
      read_model(folder.write("in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl caf\xE9\nf 1 2 3\n"));
  EXPECT_TRUE(write(folder / "o.glb", model).empty());
  EXPECT_EQ(read_model(folder / "o.glb").materials->materials.at(0).name, "caf\xEF\xBF\xBD");
}

TEST(MaterialsWrite, NamesWhatMtlDoesNotHold) {
  const TempFolder folder;
  Model model = two_materials(folder);
  Materials look{.materials = {{.name = "a", .alpha = AlphaMode::mask, .is_two_sided = true}}};
  model.materials = std::make_shared<const Materials>(look);
  EXPECT_EQ(
      write(folder / "o.obj", model),
      (std::vector<std::string>{"1 texture: tex/test texture.png", "alpha cutoff of 1 material",
                                "two-sidedness of 1 material"}));
}

}  // namespace
}  // namespace mesher::io
