#include "engine/io/pm_materials.h"

#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <string>

#include "engine/io/pm_file.h"
#include "engine/progressive/build.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

Materials brick_and_glass() {
  Materials materials;
  materials.images.push_back({.name = "wall",
                              .mime_type = "image/png",
                              .path = "textures/wall.png",
                              .bytes = std::make_shared<const std::string>("no true PNG")});
  Material& brick = materials.materials.emplace_back();
  brick.name = "brick";
  brick.base_color = {0.5F, 0.25F, 0.125F, 1.0F};
  brick.base_color_texture.image = 0;
  brick.base_color_texture.wrap_u = Wrap::clamp;
  Material& glass = materials.materials.emplace_back();
  glass.name = "glass";
  glass.alpha = AlphaMode::blend;
  glass.roughness = 0.0F;
  materials.texture_count = 1;
  return materials;
}

void expect_brick_and_glass(const Materials* materials) {
  ASSERT_NE(materials, nullptr);
  ASSERT_EQ(materials->materials.size(), 2U);
  const Material& brick = materials->materials[0];
  EXPECT_EQ(brick.name, "brick");
  EXPECT_EQ(brick.base_color.g, 0.25F);
  EXPECT_EQ(brick.base_color_texture.wrap_u, Wrap::clamp);
  ASSERT_LT(brick.base_color_texture.image, materials->images.size());
  const EncodedImage& image = materials->images[brick.base_color_texture.image];
  ASSERT_NE(image.bytes, nullptr);
  EXPECT_EQ(*image.bytes, "no true PNG");
  EXPECT_EQ(image.mime_type, "image/png");
  EXPECT_EQ(materials->materials[1].name, "glass");
  EXPECT_EQ(materials->materials[1].alpha, AlphaMode::blend);
}

TEST(PmMaterials, RoundTripWithTheirImages) {
  const Materials materials = brick_and_glass();
  const std::string bytes = encode_pm_materials(&materials);
  FileContents contents;
  expect_brick_and_glass(
      decode_pm_materials(std::as_bytes(std::span(bytes)), "x.pm", contents).get());
  EXPECT_EQ(contents[Content::materials], 2U);
  EXPECT_EQ(contents[Content::textures], 1U);
  EXPECT_TRUE(contents.warnings().empty());
}

TEST(PmMaterials, NoneTakeNoBytes) {
  const Materials none;
  FileContents contents;
  EXPECT_EQ(encode_pm_materials(nullptr), "");
  EXPECT_EQ(encode_pm_materials(&none), "");
  EXPECT_EQ(decode_pm_materials({}, "x.pm", contents), nullptr);
}

// Checksums find damage first; a writer may be wrong, too.
TEST(PmMaterials, DamageDoesNoHarm) {
  const Materials materials = brick_and_glass();
  const std::string bytes = encode_pm_materials(&materials);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x41);
    FileContents contents;
    EXPECT_NO_THROW(decode_pm_materials(std::as_bytes(std::span(damaged)), "x.pm", contents)) << i;
    const auto cut = std::as_bytes(std::span(bytes)).first(i);
    EXPECT_EQ(decode_pm_materials(cut, "x.pm", contents), nullptr) << i;
    if (i > 0) {
      EXPECT_FALSE(contents.warnings().empty()) << i;
    }
  }
}

TEST(PmFile, HoldsAttributesGroupsAndMaterials) {
  const test::TempFolder folder;
  const Mesh mesh = test::built(test::grid(10)).mesh;
  Attributes attributes;
  AttributeLayer color(color_type(), mesh.vertex_count());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    color.values<glm::u8vec4>()[v] = {v, 7, 9, 255};
  attributes.layers.push_back(std::move(color));
  attributes.groups = test::named_groups({"left", "right"});
  attributes.groups[1].material = 1;
  attributes.groups[0].mesh = 3;
  attributes.group.resize(mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    attributes.group[f] = f < 90 ? 0 : 1;
  progressive::Progressive made =
      progressive::make_progressive(mesh, attributes, {.target_faces = 10});
  const Materials materials = brick_and_glass();
  AtomicFile file(folder / "a.pm");
  const auto sizes = write_pm_file(file, made.mesh, {.attributes = &made.attributes}, &materials);
  file.commit(Flush::later);
  PmContents read = read_pm_file(folder / "a.pm");
  EXPECT_EQ(read.summary.damage, "");
  EXPECT_EQ(read.summary.attribute_bytes, sizes.attributes);
  expect_brick_and_glass(read.materials.get());
  EXPECT_EQ(read.contents[Content::color_sets], 1U);
  EXPECT_EQ(read.contents[Content::groups], 2U);
  ASSERT_EQ(read.attributes.level(), read.mesh.split_count());
  for (const std::uint32_t level : {read.mesh.split_count(), 0U}) {
    read.mesh.go_to(level);
    read.attributes.go_to(level);
    made.mesh.go_to(level);
    made.attributes.go_to(level);
    const Attributes is = read.attributes.at_level(read.mesh.mesh());
    const Attributes was = made.attributes.at_level(made.mesh.mesh());
    EXPECT_EQ(is.layers[0].bytes(), was.layers[0].bytes());
    EXPECT_EQ(is.group, was.group);
    // Indices into the materials are kept; the scene that groups named is another file's.
    EXPECT_EQ(is.groups[1].material, 1U);
    EXPECT_EQ(is.groups[0].mesh, kNone);
  }
}

}  // namespace
}  // namespace mesher::io
