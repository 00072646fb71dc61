#include "engine/io/ply_textures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "engine/io/losses.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "tests/support/attributes.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

namespace fs = std::filesystem;
using test::corners_of;
using test::read_bytes;
using test::TempFolder;

const std::string kPicture = "\x89PNG\r\n\x1A\nred";
const std::string kOtherPicture = "\x89PNG\r\n\x1A\nblue";

/// A square of two faces, with these comments, and values for each face.
std::string square(const std::string& comments, const std::string& properties,
                   const std::string& first, const std::string& second) {
  return "ply\nformat ascii 1.0\n" + comments +
         "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 2\nproperty list uchar int vertex_indices\n" +
         properties + "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 " + first + "\n3 0 2 3 " +
         second + "\n";
}

const std::string kTwoTextures = "comment TextureFile a.png\ncomment TextureFile sub/b.png\n";
const std::string kTexcoord = "property list uchar float texcoord\n";

class PlyTexturesTest : public ::testing::Test {
 protected:
  PlyTexturesTest() {
    fs::create_directory(folder_ / "sub");
    fs::create_directory(folder_ / "out");
    folder_.write("a.png", kPicture);
    folder_.write("sub/b.png", kOtherPicture);
  }
  Model read(const std::string& text) { return read_model(folder_.write("in.ply", text)); }
  /// The index of the material of a face.
  static std::uint32_t material(const Model& model, std::size_t face) {
    return model.attributes.groups[model.attributes.group[face]].material;
  }
  std::vector<std::string> write(const std::string& file, const Model& model, bool ascii = true) {
    write_model(folder_ / file, model.mesh, model.attributes,
                {.ascii = ascii, .origin = model.origin, .materials = model.materials});
    return losses_in_format(folder_ / file, model.mesh, model.attributes, model.materials.get(),
                            model.contents, model.origin);
  }

  TempFolder folder_;
};

TEST_F(PlyTexturesTest, EachTextureIsTheColorOfAMaterial) {
  const Model model = read(square(kTwoTextures, kTexcoord + "property int texnumber\n",
                                  "6 0 0 1 0 1 1 1", "6 0 0 0.5 0.5 0 1 0"));
  ASSERT_EQ(model.materials->materials.size(), 2U);
  EXPECT_EQ(model.materials->materials[0].name, "a");
  EXPECT_EQ(model.materials->materials[0].metallic, 0.0F);
  EXPECT_EQ(*model.materials->images[0].bytes, kPicture);
  EXPECT_EQ(*model.materials->images[1].bytes, kOtherPicture);
  EXPECT_EQ(material(model, 0), 1U);
  EXPECT_EQ(material(model, 1), 0U);
  EXPECT_EQ(corners_of(model).texcoord[4], glm::vec2(0.5F));
  EXPECT_TRUE(model.contents.warnings().empty());
  EXPECT_EQ(model.contents[Content::own_properties], 0U);
}

TEST_F(PlyTexturesTest, OneTextureNeedsNoNumber) {
  const Model model = read(square("comment TextureFile a.png\n", "", "", ""));
  EXPECT_EQ(material(model, 0), 0U);
  EXPECT_EQ(material(model, 1), 0U);
}

TEST_F(PlyTexturesTest, WithoutTexturesNumbersMeanNothing) {
  const Model model = read(square("", "property int texnumber\n", "0", "0"));
  EXPECT_EQ(model.materials, nullptr);
  EXPECT_TRUE(model.attributes.group.empty());
  EXPECT_EQ(model.contents.names(Content::own_properties),
            std::vector<std::string>{"face texnumber"});
}

TEST_F(PlyTexturesTest, FilesComeBackWhole) {
  const Model model = read(square(kTwoTextures, kTexcoord + "property int texnumber\n",
                                  "6 0 0 1 0 1 1 1", "6 0 0 0.5 0.5 0 1 -1"));
  for (const bool ascii : {true, false}) {
    SCOPED_TRACE(ascii);
    EXPECT_TRUE(write("out/o.ply", model, ascii).empty());
    EXPECT_EQ(read_bytes(folder_ / "out/a.png"), kPicture);
    EXPECT_EQ(read_bytes(folder_ / "out/sub/b.png"), kOtherPicture);
    const Model back = read_model(folder_ / "out/o.ply");
    EXPECT_EQ(back.attributes.groups, model.attributes.groups);
    EXPECT_EQ(back.attributes.group, model.attributes.group);
    EXPECT_EQ(corners_of(back).texcoord, corners_of(model).texcoord);
    EXPECT_EQ(back.materials->images[1].path, "sub/b.png");
  }
  EXPECT_TRUE(write("out/o.ply", model).empty());
  const std::string text = read_bytes(folder_ / "out/o.ply");
  EXPECT_NE(text.find("\n" + kTwoTextures), std::string::npos) << text;
  EXPECT_NE(text.find("\n3 0 1 2 6 0 0 1 0 1 1 1\n3 0 2 3 6 0 0 0.5 0.5 0 1 -1\n"),
            std::string::npos)
      << text;
}

TEST_F(PlyTexturesTest, NumbersAreWrittenOnlyIfTheyDiffer) {
  const Model one = read(square("comment TextureFile a.png\n", "", "", ""));
  write("out/o.ply", one);
  EXPECT_EQ(read_bytes(folder_ / "out/o.ply").find("texnumber"), std::string::npos);
  const Model some =
      read(square("comment TextureFile a.png\n", "property char texnumber\n", "0", "-1"));
  write("out/o.ply", some);
  EXPECT_NE(read_bytes(folder_ / "out/o.ply").find("\n3 0 1 2 0\n3 0 2 3 -1\n"), std::string::npos);
}

TEST_F(PlyTexturesTest, NumbersOutOfRangeAreCounted) {
  for (const char* number : {"2", "2000000000"}) {
    const Model model = read(square(kTwoTextures, "property int texnumber\n", number, "1"));
    EXPECT_EQ(material(model, 0), kNone);
    EXPECT_EQ(material(model, 1), 1U);
    EXPECT_EQ(model.contents.warnings(),
              std::vector<std::string>{"1 face with a texnumber out of range: no texture"});
  }
}

TEST_F(PlyTexturesTest, ListsOfAnotherLengthCostTheFaceItsCoordinates) {
  for (const char* list : {"5 0 0 1 0 1", "2 0 0", "8 0 0 1 0 1 1 0 1"}) {
    const Model model =
        read(square("comment TextureFile a.png\n", kTexcoord, list, "6 0 0 0.5 0.5 0 1"));
    const CornerAttributes corners = corners_of(model);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_TRUE(std::isnan(corners.texcoord[c].x));
      EXPECT_FALSE(std::isnan(corners.texcoord[c + 3].x));
    }
    EXPECT_EQ(model.contents.warnings(),
              std::vector<std::string>{"1 face without two texcoord values per corner: no texture "
                                       "coordinates"});
  }
  const Model none = read(square("comment TextureFile a.png\n", kTexcoord, "0", "6 0 0 1 0 0 1"));
  EXPECT_TRUE(none.contents.warnings().empty()) << "a face may have none";
}

TEST_F(PlyTexturesTest, FilesOutsideTheFolderAreNotOpened) {
  folder_.write("secret.png", kPicture);
  const std::string text =
      square("comment TextureFile ../secret.png\n", kTexcoord, "6 0 0 1 0 1 1", "6 0 0 1 1 0 1");
  const Model model = read_model(folder_.write("sub/in.ply", text));
  EXPECT_EQ(model.materials->images[0].bytes, nullptr);
  ASSERT_EQ(model.contents.warnings().size(), 1U);
  EXPECT_NE(model.contents.warnings()[0].find("outside"), std::string::npos);
  // Named again, but neither read nor written.
  EXPECT_TRUE(write("out/o.ply", model).empty());
  EXPECT_NE(read_bytes(folder_ / "out/o.ply").find("comment TextureFile ../secret.png\n"),
            std::string::npos);
}

TEST_F(PlyTexturesTest, BackslashesAndBlanksMayBeInNames) {
  folder_.write("sub/my picture.png", kPicture);
  const Model model = read(square("comment TextureFile sub\\my picture.png\n", "", "", ""));
  ASSERT_NE(model.materials->images[0].bytes, nullptr);
  EXPECT_EQ(*model.materials->images[0].bytes, kPicture);
}

TEST_F(PlyTexturesTest, ControlCharactersDoNotEndTheComment) {
  Materials materials;
  materials.materials.emplace_back().base_color_texture.image = 0;
  materials.images.push_back({.path = "a\nelement vertex 9.png"});
  Model model = read(square("comment TextureFile a.png\n", "", "", ""));
  model.materials = std::make_shared<const Materials>(materials);
  write("out/o.ply", model);
  EXPECT_NE(read_bytes(folder_ / "out/o.ply").find("TextureFile a_element vertex 9.png\n"),
            std::string::npos);
}

TEST_F(PlyTexturesTest, OnlyPlainColorTexturesAreHeld) {
  Materials materials;
  materials.images.push_back({.path = "a.png"});
  materials.images.push_back({});  // embedded, and damaged
  for (int i = 0; i < 5; ++i)
    materials.materials.emplace_back().base_color_texture.image = 0;
  materials.materials[1].base_color_texture.set = 1;
  materials.materials[2].base_color_texture.scale.x = 2.0F;
  materials.materials[3].base_color_texture.image = 1;
  materials.materials[4].base_color_texture.wrap_u = Wrap::clamp;
  const PlyTextures held = ply_textures(materials);
  EXPECT_EQ(held.images, std::vector<std::uint32_t>{0});
  EXPECT_EQ(held.of_material, (std::vector<std::uint32_t>{0, kNone, kNone, kNone, 0}));
}

TEST_F(PlyTexturesTest, OtherFormatsGetTheMaterials) {
  const Model model = read(square(kTwoTextures, kTexcoord + "property int texnumber\n",
                                  "6 0 0 1 0 1 1 1", "6 0 0 0.5 0.5 0 1 0"));
  EXPECT_TRUE(write("out/o.obj", model).empty());
  EXPECT_TRUE(write("out/o.glb", model).empty());
  const Model obj = read_model(folder_ / "out/o.obj");
  EXPECT_EQ(obj.materials->materials[0].name, "a");
  // And back: MTL has names and colors that PLY does not have.
  EXPECT_EQ(write("out/o.ply", obj),
            (std::vector<std::string>{"2 materials: a, b", "1 material file: o.mtl"}));
  EXPECT_EQ(write("out/o.stl", model),
            (std::vector<std::string>{"texture coordinates", "2 textures: a.png, sub/b.png"}));
}

}  // namespace
}  // namespace mesher::io
