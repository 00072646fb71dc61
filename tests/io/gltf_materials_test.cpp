#include "engine/io/gltf_materials.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/io/gltf_types.h"
#include "engine/io/read.h"
#include "tests/support/gltf_document.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using test::GltfDocument;
using test::TempFolder;

const std::string kImageBytes = "\x89PNG\r\n\x1A\n";
const std::string kWebpBytes = std::string("RIFF\4\0\0\0WEBP", 12);

/// Reads a square with the given materials, textures and images. View 0 is a PNG, view 1 a WebP.
Model read_square(const TempFolder& folder, const std::string& members) {
  GltfDocument document;
  document.view(kImageBytes);
  document.view(kWebpBytes);
  const int corners = document.floats(test::kSquareCorners, "VEC3", 3);
  const int indices = document.indices(test::kSquareIndices);
  return read_model(folder.write(
      "m.gltf", document.text(members + R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":)" +
                              std::to_string(corners) + R"(},"indices":)" +
                              std::to_string(indices) + R"(,"material":0}]}])")));
}

TEST(GltfMaterials, ReadsEveryTerm) {
  const TempFolder folder;
  const Model model = read_square(folder, R"("materials":[{"name":"m",
      "pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,0.25],"metallicFactor":0.5,
        "roughnessFactor":0.75,"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":
        {"offset":[0.5,0],"scale":[2,3],"rotation":1,"texCoord":1}}},
        "metallicRoughnessTexture":{"index":0}},
      "normalTexture":{"index":0,"scale":0.5},"occlusionTexture":{"index":0,"strength":0.25},
      "emissiveTexture":{"index":0},"emissiveFactor":[1,0,0],"alphaMode":"MASK","alphaCutoff":0.25,
      "doubleSided":true,"extensions":{"KHR_materials_unlit":{},
        "KHR_materials_emissive_strength":{"emissiveStrength":4}}}],
      "textures":[{"source":0,"sampler":0}],"images":[{"bufferView":0,"mimeType":"image/png"}],
      "samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728,"minFilter":9728}])");
  EXPECT_EQ(model.attributes.groups, (std::vector<FaceGroup>{{.material = 0}}));
  const Material& m = model.materials->materials.at(0);
  EXPECT_EQ(m.base_color, glm::vec4(1.0F, 0.5F, 0.0F, 0.25F));
  EXPECT_EQ(m.metallic, 0.5F);
  EXPECT_EQ(m.roughness, 0.75F);
  EXPECT_EQ(m.emission, glm::vec3(4.0F, 0.0F, 0.0F));
  EXPECT_EQ(m.alpha, AlphaMode::mask);
  EXPECT_EQ(m.alpha_cutoff, 0.25F);
  EXPECT_TRUE(m.is_two_sided);
  EXPECT_TRUE(m.is_unlit);
  EXPECT_EQ(m.normal_texture.strength, 0.5F);
  EXPECT_EQ(m.occlusion_texture.strength, 0.25F);
  const Texture& t = m.base_color_texture;
  EXPECT_EQ(t.offset, glm::vec2(0.5F, 0.0F));
  EXPECT_EQ(t.scale, glm::vec2(2.0F, 3.0F));
  EXPECT_EQ(t.angle_rad, 1.0F);
  EXPECT_EQ(t.set, 1U);
  EXPECT_EQ(t.wrap_u, Wrap::clamp);
  EXPECT_EQ(t.wrap_v, Wrap::mirrored_repeat);
  EXPECT_TRUE(t.magnifies_to_pixels && t.minifies_to_pixels);
  EXPECT_EQ(t.mipmaps, Mipmaps::none);
  EXPECT_EQ(*model.materials->images.at(0).bytes, kImageBytes);
  EXPECT_EQ(model.materials->texture_count, 1U);
}

TEST(GltfMaterials, FiltersOfMinificationAreNumbersAndBack) {
  for (const std::uint32_t number : {9728U, 9729U, 9984U, 9985U, 9986U, 9987U})
    EXPECT_EQ(min_filter_number(min_filter(number)), number);
  EXPECT_EQ(min_filter(9986), (GltfMinFilter{.is_nearest = true, .mipmaps = Mipmaps::blended}));
  EXPECT_EQ(min_filter(0), GltfMinFilter());
}

TEST(GltfMaterials, PrefersWebpAndFallsBack) {
  const TempFolder folder;
  const std::string material =
      R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)";
  const std::string images = R"("images":[{"bufferView":0},{"bufferView":1}],)";
  const auto type_of = [&](const std::string& texture) {
    const Model model = read_square(folder, material + images + R"("textures":[)" + texture + "]");
    return model.materials->images.at(0).mime_type;
  };
  EXPECT_EQ(type_of(R"({"source":0,"extensions":{"EXT_texture_webp":{"source":1}}})"),
            "image/webp");
  EXPECT_EQ(type_of(R"({"source":0,"extensions":{"KHR_texture_basisu":{"source":1}}})"),
            "image/png");
  EXPECT_EQ(type_of(R"({"extensions":{"MSFT_texture_dds":{"source":0}}})"), "image/png");
}

TEST(GltfMaterials, ReadsFilesAndDataBeside) {
  const TempFolder folder;
  folder.write("a b.png", kImageBytes);
  const std::string material =
      R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
         "textures":[{"source":0}],"images":[{"uri":")";
  const Model file = read_square(folder, material + R"(a%20b.png"}])");
  EXPECT_EQ(*file.materials->images.at(0).bytes, kImageBytes);
  EXPECT_EQ(file.materials->images[0].path, "a b.png");
  const Model data = read_square(
      folder, material + "data:image/png;base64," + test::base64(kImageBytes) + R"("}])");
  EXPECT_EQ(*data.materials->images.at(0).bytes, kImageBytes);
}

// The shape of a file does not suffer from its look.
TEST(GltfMaterials, WhatIsMalformedOrMissingCostsNoShape) {
  const TempFolder folder;
  const std::string texture =
      R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
         "textures":[{"source":0}],"images":[)";
  for (const std::string image :
       {R"({"uri":"../a.png"})", R"({"uri":"/dev/zero"})", R"({"uri":"http://a/b.png"})",
        R"({"uri":"no.png"})", R"({"uri":"data:image/png;base64,#"})", R"({"bufferView":99})",
        R"({"uri":5})", "7", R"({"bufferView":-1})"}) {
    const Model model = read_square(folder, texture + image + "]");
    EXPECT_EQ(model.mesh.face_count(), 2U) << image;
    EXPECT_EQ(model.contents.warnings().size(), 1U) << image;
    EXPECT_FALSE(model.materials->images.at(0).bytes) << image;
  }
  for (const std::string material :
       {R"({"pbrMetallicRoughness":7})", R"({"pbrMetallicRoughness":{"baseColorFactor":[1,2]}})",
        R"({"pbrMetallicRoughness":{"baseColorFactor":["a",1e300,{},2]}})",
        R"({"normalTexture":{"index":-1}})", R"({"normalTexture":{"index":5}})",
        R"({"alphaMode":7,"alphaCutoff":"x","doubleSided":"y","extensions":[]})"}) {
    const Model model = read_square(folder, "\"materials\":[" + material + "]");
    EXPECT_EQ(model.materials->materials.size(), 1U) << material;
  }
}

TEST(GltfMaterials, OneBufferViewForManyImagesIsBounded) {
  const TempFolder folder;
  std::string members = R"("textures":[)";
  std::string images = R"("images":[)";
  std::string materials = R"("materials":[)";
  for (int i = 0; i < 2000; ++i) {
    const std::string comma = i > 0 ? "," : "";
    const std::string index = std::to_string(i);
    members += comma + R"({"source":)" + index + "}";
    images += comma + R"({"bufferView":2})";
    materials += comma + R"({"emissiveTexture":{"index":)" + index + "}}";
  }
  GltfDocument document;
  const int corners = document.floats(test::kSquareCorners, "VEC3", 3);
  const int indices = document.indices(test::kSquareIndices);
  document.view(std::string(100000, 'x'));
  const Model model = read_model(folder.write(
      "m.gltf", document.text(members + "]," + images + "]," + materials +
                              R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":)" +
                              std::to_string(corners) + R"(},"indices":)" +
                              std::to_string(indices) + "}]}]")));
  std::size_t bytes = 0;
  for (const EncodedImage& image : model.materials->images)
    bytes += image.bytes ? image.bytes->size() : 0;
  EXPECT_LT(bytes, 1000000U);
  EXPECT_FALSE(model.contents.warnings().empty());
}

}  // namespace
}  // namespace mesher::io
