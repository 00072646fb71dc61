#include "engine/io/gltf_mesh.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/io/gltf_scene.h"
#include "tests/support/attributes.h"
#include "tests/support/gltf_scene_file.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using test::GltfDocument;
using test::TempFolder;

/// Returns the only mesh with triangles of a document.
Model mesh_in(const std::string& text, const ReadOptions& options = {}) {
  const TempFolder folder;
  GltfScene scene(folder.write("m.gltf", text), options);
  std::vector<GltfSceneMesh> meshes = scene.read_meshes(options);
  EXPECT_EQ(meshes.size(), 1U);
  test::expect_valid_attributes(meshes.front().model);
  return std::move(meshes.front().model);
}

std::string refusal_of_mesh(const std::string& text) {
  try {
    mesh_in(text);
  } catch (const InputError& error) {
    return error.reason();
  }
  return "was not refused";
}

// A border of materials is a line on one surface, not a crack.
TEST(GltfMesh, PrimitivesAreOneSurface) {
  const Model model = mesh_in(test::scene_file());
  EXPECT_EQ(model.name, "sheet");
  EXPECT_EQ(model.mesh.face_count(), 4U);
  EXPECT_EQ(model.mesh.vertex_count(), 6U);
  EXPECT_EQ(model.report[Repair::vertices_joined], 2U);
  EXPECT_EQ(model.attributes.groups, (std::vector<FaceGroup>{{.material = 0, .primitive = 0},
                                                             {.material = 1, .primitive = 1}}));
  EXPECT_EQ(model.attributes.group, (Array<std::uint32_t>{0, 0, 1, 1}));
  // The corners of the second square have no texture coordinates: wedges of their own.
  EXPECT_EQ(model.attributes.further.size(), 2U);
  const AttributeLayer* uv = model.attributes.find("TEXCOORD_0");
  ASSERT_NE(uv, nullptr);
  EXPECT_TRUE(uv->type().counts_down);
  const auto has_uv = [&](std::uint32_t face) {
    const Wedge w = model.attributes.wedge(model.mesh.origins(), Mesh::halfedge(Face(face)));
    return !is_absent(*uv, w.index());
  };
  EXPECT_TRUE(has_uv(0));
  EXPECT_FALSE(has_uv(2));
}

TEST(GltfMesh, VerticesStayApartIfNotJoined) {
  const Model model = mesh_in(test::scene_file(), {.weld = std::nullopt});
  EXPECT_EQ(model.mesh.vertex_count(), 8U);
}

/// Two triangles in two primitives, with an attribute of each; `types` are component types.
std::string two_types(const std::string& name, int first, int second) {
  GltfDocument file;
  file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
  file.floats({5, 0, 0, 6, 0, 0, 5, 1, 0}, "VEC3", 3);
  file.accessor("\"bufferView\":" + std::to_string(file.view(std::string(48, '\1'))), first, "VEC4",
                3);
  file.accessor("\"bufferView\":" + std::to_string(file.view(std::string(48, '\1'))), second,
                "VEC4", 3);
  return file.text(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,")" + name +
                   R"(":2}},{"attributes":{"POSITION":1,")" + name + R"(":3}}]}])");
}

TEST(GltfMesh, AttributesKeepTheirTypes) {
  const auto type_of = [](const std::string& name, int first, int second) {
    const Model model = mesh_in(two_types(name, first, second));
    return model.attributes.layers.at(0).type();
  };
  constexpr int kByte = 5121;
  constexpr int kShort = 5123;
  constexpr int kFloat = 5126;
  EXPECT_EQ(type_of("JOINTS_0", kByte, kByte).component, ComponentType::u8);
  EXPECT_EQ(type_of("JOINTS_0", kByte, kShort).component, ComponentType::u16);
  EXPECT_EQ(type_of("WEIGHTS_0", kFloat, kFloat).component, ComponentType::f32);
  EXPECT_EQ(type_of("_ID", kShort, kShort).component, ComponentType::u16);
  EXPECT_EQ(type_of("_ID", kShort, kFloat).component, ComponentType::f32);
  // Integers that are no fractions could not be blended.
  EXPECT_EQ(type_of("TANGENT", kByte, kByte).component, ComponentType::f32);
}

TEST(GltfMesh, MorphTargetsAreLayers) {
  GltfDocument file;
  file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
  file.floats({0, 0, 1, 0, 0, 2, 0, 0, 3}, "VEC3", 3);
  const Model model = mesh_in(file.text(
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":1},{"POSITION":0}]}]}])"));
  const AttributeLayer* layer = model.attributes.find(morph_layer(0, "POSITION"));
  ASSERT_NE(layer, nullptr);
  EXPECT_EQ(layer->type().kind, AttributeKind::delta);
  EXPECT_EQ(load(*layer, 2)[2], 3.0);
  EXPECT_NE(model.attributes.find("target 1 POSITION"), nullptr);
}

TEST(GltfMesh, RefusesBadPrimitives) {
  const auto document = [](const std::string& primitive) {
    GltfDocument file;
    file.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
    file.floats({0, 0, 1, 1}, "VEC2", 2);
    return file.text(R"("meshes":[{"primitives":)" + primitive + "}]");
  };
  EXPECT_EQ(refusal_of_mesh(document("7")), "a mesh has no primitives");
  EXPECT_EQ(refusal_of_mesh(document("[7]")), "a primitive is not an object");
  EXPECT_EQ(refusal_of_mesh(document(R"([{"attributes":{"POSITION":0,"TEXCOORD_0":1}}])")),
            "attributes have different lengths");
  EXPECT_EQ(refusal_of_mesh(document(R"([{"attributes":{"POSITION":0},"material":3}])")),
            "index into materials out of range");
  EXPECT_EQ(refusal_of_mesh(document(R"([{"attributes":{"POSITION":0},"targets":[1]}])")),
            "a morph target is not an object");
}

// A small file cannot ask for gigabytes by naming its data again and again.
TEST(GltfMesh, RepeatedDataHasALimit) {
  GltfDocument file;
  const std::size_t vertices = 90000;
  file.floats(std::vector<float>(3 * vertices, 1.0F), "VEC3", 3);
  std::string attributes = R"("POSITION":0)";
  for (int i = 0; i < 1000; ++i)
    attributes += R"(,"_A)" + std::to_string(i) + R"(":0)";
  EXPECT_EQ(refusal_of_mesh(
                file.text(R"("meshes":[{"primitives":[{"attributes":{)" + attributes + "}}]}]")),
            "its meshes are instanced too often for the size of the file");
}

}  // namespace
}  // namespace mesher::io
