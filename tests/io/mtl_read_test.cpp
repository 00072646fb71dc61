#include "engine/io/mtl_read.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "engine/io/mtl_look.h"
#include "engine/io/obj_materials.h"
#include "engine/io/read.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using test::TempFolder;

const std::string kPngStart = "\x89PNG\r\n\x1A\n";

struct ReadMtl {
  Materials materials;
  FileContents contents;
};

ReadMtl read_mtl(const std::string& text) {
  const TempFolder folder;
  ReadMtl result;
  MtlReader(result.materials, result.contents).read(MappedFile(folder.write("m.mtl", text)));
  return result;
}

Material look_of(const std::string& statements) {
  const ReadMtl mtl = read_mtl("newmtl a\n" + statements);
  EXPECT_TRUE(mtl.contents.warnings().empty()) << mtl.contents.warnings().front();
  return mtl.materials.materials.at(0);
}

Model read_obj_with(const TempFolder& folder, const std::string& head) {
  return read_model(folder.write("m.obj", head + "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"));
}

TEST(MtlRead, KeepsStatementsAsWritten) {
  const ReadMtl mtl = read_mtl(
      "# head\n\nnewmtl Red Paint (2)\r\n\tKd  1 0 0 \r\n# why\nsome thing else\nnewmtl b\n");
  ASSERT_EQ(mtl.materials.materials.size(), 2U);
  EXPECT_EQ(mtl.materials.materials[0].name, "Red Paint (2)");
  EXPECT_EQ(mtl.materials.materials[0].mtl_statements,
            (std::vector<std::string>{"Kd  1 0 0", "# why", "some thing else"}));
  EXPECT_TRUE(mtl.materials.materials[1].mtl_statements->empty());
}

// Colors are sRGB, factors linear: both directions.
TEST(MtlRead, ColorsAreSrgb) {
  const Material material = look_of("Kd 0.5 1 0\nKe .25\n");
  EXPECT_NEAR(material.base_color.r, 0.214041F, 1e-6F);
  EXPECT_EQ(material.base_color.g, 1.0F);
  EXPECT_NEAR(material.emission.b, 0.0508761F, 1e-6F);
  const std::vector<std::string> back = mtl_statements(material, {});
  EXPECT_EQ(back[0], "Kd 0.5 1 0");
  EXPECT_EQ(back[1], "Ke 0.25 0.25 0.25");
}

TEST(MtlRead, ExponentBecomesRoughness) {
  EXPECT_FLOAT_EQ(look_of("Ns 30\n").roughness, 0.5F);  // (2 / 32)^(1/4)
  EXPECT_EQ(look_of("Ns 30\nillum 1\n").roughness, 1.0F);
  EXPECT_EQ(look_of("Ns 30\nKs 0 0 0\n").roughness, 1.0F);
  EXPECT_EQ(look_of("Ns 30\nPr 0.25\nPm 1\n").roughness, 0.25F);
  const std::vector<std::string> back = mtl_statements({.roughness = 0.5F}, {});
  EXPECT_NE(std::ranges::find(back, "Ns 30"), back.end());
  EXPECT_EQ(look_of("").metallic, 0.0F);
}

TEST(MtlRead, OpacityBecomesAlpha) {
  EXPECT_EQ(look_of("d 0.25\n").base_color.a, 0.25F);
  EXPECT_EQ(look_of("d -halo 0.25\n").base_color.a, 0.25F);
  EXPECT_EQ(look_of("Tr 0.25\n").base_color.a, 0.75F);
  EXPECT_EQ(look_of("Tr 0.25\n").alpha, AlphaMode::blend);
  EXPECT_EQ(look_of("d 1\nmap_Kd a.png\n").alpha, AlphaMode::opaque);
  EXPECT_EQ(look_of("map_Kd a.png\nmap_d a.png\n").alpha, AlphaMode::blend);
  EXPECT_EQ(look_of("map_Kd a.png\nmap_d b.png\n").alpha, AlphaMode::opaque);
}

TEST(MtlRead, ReadsOptionsOfMaps) {
  const Material m = look_of("map_Kd -blendu on -s 2 3 -o 0.5 0.25 0 -clamp on -mm 0 1 my a.png\n");
  const Texture& texture = m.base_color_texture;
  EXPECT_EQ(texture.scale, glm::vec2(2.0F, 3.0F));
  EXPECT_EQ(texture.offset, glm::vec2(0.5F, 1.0F - 3.0F - 0.25F));
  EXPECT_EQ(texture.wrap_v, Wrap::clamp);
  const std::vector<std::string> back = mtl_statements(m, {"my a.png"});
  EXPECT_NE(std::ranges::find(back, "map_Kd -s 2 3 1 -o 0.5 0.25 0 -clamp on my a.png"),
            back.end());
  EXPECT_EQ(look_of("norm -bm 0.5 n.png\n").normal_texture.strength, 0.5F);
  EXPECT_FALSE(look_of("bump -bm 0.5 n.png\n").normal_texture.is_there());
  const Material surface = look_of("map_Pr -imfchan g s.png\nmap_Pm -imfchan b s.png\n");
  EXPECT_TRUE(surface.metallic_roughness_texture.is_there());
}

TEST(MtlRead, MalformedStatementsAreNamedWithTheirLine) {
  const ReadMtl mtl = read_mtl("newmtl a\nKd 1 x 0\n\nNs\nmap_Kd -s q a.png\nd nan\n");
  EXPECT_EQ(mtl.contents.warnings(),
            (std::vector<std::string>{"m.mtl:2: malformed Kd 1 x 0", "m.mtl:4: malformed Ns",
                                      "m.mtl:5: malformed map_Kd -s q a.png",
                                      "m.mtl:6: malformed d nan"}));
  EXPECT_EQ(mtl.materials.materials[0].base_color, glm::vec4(1.0F));
  EXPECT_EQ(mtl.materials.materials[0].mtl_statements->size(), 4U);
}

TEST(MtlRead, NamesWhatGltfDoesNotHold) {
  const Material m =
      look_of("Ka 0 0 0\nKs 1 1 1\nmap_Bump b.png\nillum 7\nmap_Kd a.png\nmap_d b.png\nglow 1\n");
  EXPECT_EQ(lost_in_gltf(m),
            (std::vector<std::string>{"ambient color", "bump map", "glow", "illumination model",
                                      "opacity map", "specular color"}));
  EXPECT_TRUE(lost_in_gltf(look_of("Kd 1 1 1\nNs 5\nd 1\nillum 2\nmap_Kd a.png\n")).empty());
}

TEST(MtlRead, FindsFilesInEverySpelling) {
  EXPECT_EQ(mtl_file_names("a.mtl b c.MTL \"d e\" f"),
            (std::vector<std::string>{"a.mtl", "b c.MTL", "d e", "f"}));
  EXPECT_TRUE(mtl_file_names("\"").empty());
  const TempFolder folder;
  std::filesystem::create_directory(folder / "sub");
  folder.write("sub/my m.mtl", "newmtl a\nmap_Kd sub\\a.png\n");
  folder.write("sub/a.png", kPngStart);
  for (const char* name : {"sub/my m.mtl", "\"sub/my m.mtl\"", "sub\\my m.mtl"}) {
    const Model model = read_obj_with(folder, std::string("mtllib ") + name + "\n");
    EXPECT_TRUE(model.contents.warnings().empty()) << name;
    ASSERT_EQ(model.materials->images.size(), 1U) << name;
    EXPECT_EQ(*model.materials->images[0].bytes, kPngStart);
    EXPECT_EQ(model.materials->images[0].mime_type, "image/png");
  }
}

TEST(MtlRead, OpensNothingOutsideOfTheFolder) {
  const TempFolder folder;
  folder.write("m.mtl", "newmtl a\nmap_Kd ../a.png\nmap_Ke /dev/zero\nbump C:\\a.png\n");
  const Model model = read_obj_with(folder, "mtllib m.mtl /etc/x.mtl ../y.mtl no.mtl\n");
  EXPECT_EQ(model.contents.warnings().size(), 6U);
  EXPECT_EQ(model.materials->missing_files.size(), 3U);
  for (const EncodedImage& image : model.materials->images)
    EXPECT_FALSE(image.bytes) << image.path;
}

TEST(MtlRead, FilesThatCannotBeReadCostNoShape) {
  const TempFolder folder;
  folder.write("m.mtl", "\xFF\xFEn\0e\0w\0");
  const Model model = read_obj_with(folder, "mtllib m.mtl\n");
  EXPECT_EQ(model.mesh.face_count(), 1U);
  ASSERT_EQ(model.contents.warnings().size(), 1U);
  EXPECT_EQ(model.materials->missing_files, std::vector<std::string>{"m.mtl"});
}

}  // namespace
}  // namespace mesher::io
