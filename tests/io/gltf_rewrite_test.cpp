#include "engine/io/gltf_rewrite.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/io/gltf_scene.h"
#include "engine/io/gltf_uses.h"
#include "engine/mesh/mesh_editor.h"
#include "tests/support/gltf_scene_file.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using nlohmann::json;
using test::GltfDocument;
using test::TempFolder;

class GltfRewrite : public testing::Test {
 protected:
  /// Opens a document, and its meshes.
  void open(const std::string& text) {
    scene_.emplace(folder_.write("in.gltf", text));
    meshes_ = scene_->read_meshes();
  }
  /// Writes it with these edits and returns the JSON of the file.
  json rewrite(std::span<const GltfMeshEdit> edits, bool binary = false) {
    const GltfRewriter rewriter(scene_->document(), edits);
    losses_ = rewriter.losses();
    AtomicFile file(folder_ / out(binary));
    rewriter.write(file, binary);
    file.commit();
    const std::string bytes = test::read_bytes(folder_ / out(binary));
    if (!binary) return json::parse(bytes);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    return json::parse(bytes.substr(20, length));
  }
  GltfMeshEdit edit_of(const GltfSceneMesh& mesh) {
    return {.mesh = mesh.index, .levels = {{&mesh.model.mesh, &mesh.model.attributes}}};
  }
  /// The values of an accessor of the written file.
  Array<float> values(std::uint64_t accessor, std::size_t components, bool binary = false) {
    const MappedFile file(folder_ / out(binary));
    GltfFile gltf(file, nullptr);
    return gltf.floats(accessor, components, 0, gltf.element_count(accessor));
  }
  static const char* out(bool binary) { return binary ? "out.glb" : "out.gltf"; }

  TempFolder folder_;
  std::optional<GltfScene> scene_;
  std::vector<GltfSceneMesh> meshes_;
  std::vector<std::string> losses_;
};

/// The document without what says where its bytes lie.
json without_places(json document) {
  document.erase("buffers");
  for (json& view : document["bufferViews"])
    view.erase("byteOffset");
  return document;
}

TEST_F(GltfRewrite, CopyKeepsEverything) {
  open(test::scene_file());
  for (const bool binary : {false, true}) {
    const json copy = rewrite({}, binary);
    EXPECT_EQ(without_places(copy), without_places(json::parse(test::scene_file())));
    EXPECT_EQ(values(3, 3, binary), (Array<float>{1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0}));
    EXPECT_EQ(values(2, 2, binary), (Array<float>{0, 0, 1, 0, 1, 1, 0, 1}));
    EXPECT_EQ(values(4, 1, binary), (Array<float>{0, 1}));
    EXPECT_TRUE(losses_.empty());
  }
}

TEST_F(GltfRewrite, EditReplacesThePrimitivesOfItsMeshOnly) {
  open(test::scene_file());
  meshes_[0].model.mesh.set_position(Vertex(0), {0, 0, 5});
  const json before = json::parse(test::scene_file());
  const json after = rewrite(std::vector{edit_of(meshes_[0])});
  for (const char* part :
       {"nodes", "cameras", "materials", "animations", "scenes", "extras", "extensions"})
    EXPECT_EQ(after[part], before[part]) << part;
  EXPECT_EQ(after["meshes"][1], before["meshes"][1]);
  const json& primitives = after["meshes"][0]["primitives"];
  ASSERT_EQ(primitives.size(), 2U);
  EXPECT_EQ(primitives[0]["material"], 0);
  EXPECT_EQ(primitives[0]["extras"], "left");
  EXPECT_TRUE(primitives[0]["attributes"].contains("TEXCOORD_0"));
  EXPECT_FALSE(primitives[1]["attributes"].contains("TEXCOORD_0"));
  const Array<float> positions = values(primitives[0]["attributes"]["POSITION"], 3);
  EXPECT_EQ(positions, (Array<float>{0, 0, 5, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  EXPECT_EQ(values(primitives[0]["attributes"]["TEXCOORD_0"], 2),
            (Array<float>{0, 0, 1, 0, 1, 1, 0, 1}));
  // Points and the animation still have theirs, and so has the extension that nobody knows.
  EXPECT_EQ(values(0, 3)[2], 0.0F);
  EXPECT_EQ(values(5, 4), (Array<float>{0, 0, 0, 1, 0, 0, 1, 0}));
  EXPECT_TRUE(losses_.empty());
}

// What the edit leaves unused is used again, so that the file does not keep the old vertices.
TEST_F(GltfRewrite, UnusedAccessorsMakeRoom) {
  open(test::scene_file());
  const json before = json::parse(test::scene_file());
  const json after = rewrite(std::vector{edit_of(meshes_[0])});
  // Both squares used the indices of accessor 1; now each has its own. Accessor 0 is kept for the
  // points.
  EXPECT_EQ(after["accessors"].size(), before["accessors"].size() + 2);
  EXPECT_EQ(after["bufferViews"].size(), after["accessors"].size());
}

TEST_F(GltfRewrite, EmptyPrimitivesGo) {
  open(test::scene_file());
  Attributes attributes = meshes_[0].model.attributes;
  std::ranges::fill(attributes.group, 1U);
  const GltfMeshEdit edit{.mesh = 0, .levels = {{&meshes_[0].model.mesh, &attributes}}};
  const json after = rewrite(std::span(&edit, 1));
  ASSERT_EQ(after["meshes"][0]["primitives"].size(), 1U);
  EXPECT_EQ(after["meshes"][0]["primitives"][0]["material"], 1);
}

TEST_F(GltfRewrite, LevelsHangOnTheNodes) {
  open(test::scene_file());
  const GltfLevel level{&meshes_[0].model.mesh, &meshes_[0].model.attributes, 0.25};
  const GltfMeshEdit edit{
      .mesh = 0, .levels = {{level.mesh, level.attributes, 0.5}, level}, .replaces = false};
  const json after = rewrite(std::span(&edit, 1));
  EXPECT_EQ(after["meshes"].size(), 3U);
  EXPECT_EQ(after["meshes"][2]["name"], "sheet_lod1");
  EXPECT_EQ(after["extensionsUsed"], json({"VENDOR_rig", "MSFT_lod"}));
  // "a" has a child of its own, which must not vanish with the level: a further child shows the
  // mesh.
  EXPECT_FALSE(after["nodes"][1].contains("mesh"));
  const json children = after["nodes"][1]["children"];
  ASSERT_EQ(children.size(), 2U);
  const json& shown = after["nodes"][children[1].get<std::size_t>()];
  EXPECT_EQ(shown["mesh"], 0);
  const std::size_t coarse = shown["extensions"]["MSFT_lod"]["ids"][0];
  EXPECT_EQ(after["nodes"][coarse]["mesh"], 2);
  // "b" names its level itself, and keeps what it had.
  EXPECT_EQ(after["nodes"][3]["extras"], json({{"id", 7}, {"MSFT_screencoverage", {0.5, 0.25}}}));
  const std::size_t level_of_b = after["nodes"][3]["extensions"]["MSFT_lod"]["ids"][0];
  EXPECT_EQ(after["nodes"][level_of_b]["name"], "b_lod1");
}

// What moves a node moves the levels that take its place. A node that shows its mesh by a child
// moves the child, so only the weights of its mesh go there.
TEST_F(GltfRewrite, LevelsFollowAnimations) {
  json document = json::parse(test::scene_file());
  document["nodes"][3]["skin"] = 0;
  document["skins"] = json::parse(R"([{"joints":[0]}])");
  document["animations"][0]["channels"] = json::parse(R"([
    {"sampler":0,"target":{"node":1,"path":"rotation"}},
    {"sampler":0,"target":{"node":1,"path":"weights"}},
    {"sampler":0,"target":{"node":3,"path":"rotation"}},
    {"sampler":0,"target":{"node":0,"path":"rotation"}}])");
  open(document.dump());
  const GltfLevel level{&meshes_[0].model.mesh, &meshes_[0].model.attributes, 0.25};
  const GltfMeshEdit edit{.mesh = 0, .levels = {level, level, level}, .replaces = false};
  const json after = rewrite(std::span(&edit, 1));
  const json& nodes = after["nodes"];
  const std::size_t child = nodes[1]["children"][1];
  const json ids_of_child = nodes[child]["extensions"]["MSFT_lod"]["ids"];
  const json ids_of_b = nodes[3]["extensions"]["MSFT_lod"]["ids"];
  for (const json& id : ids_of_b)
    EXPECT_EQ(nodes[id.get<std::size_t>()]["skin"], 0);
  std::map<std::string, std::set<std::size_t>> targets;
  for (const json& channel : after["animations"][0]["channels"])
    targets[channel["target"]["path"]].insert(channel["target"]["node"].get<std::size_t>());
  EXPECT_EQ(targets["rotation"], (std::set<std::size_t>{0, 1, 3, ids_of_b[0], ids_of_b[1]}));
  EXPECT_EQ(targets["weights"], (std::set<std::size_t>{child, ids_of_child[0], ids_of_child[1]}));
}

/// A document with images, whose files are named by `uris`.
std::string with_images(const std::vector<std::string>& uris) {
  json images = json::array();
  for (const std::string& uri : uris)
    images.push_back({{"uri", uri}, {"name", "picture"}});
  return json({{"asset", {{"version", "2.0"}}}, {"images", images}}).dump();
}

TEST_F(GltfRewrite, ImagesAreEmbeddedOnce) {
  const std::string png = "\x89PNG\r\n\x1A\n and more";
  folder_.write("a.png", png);
  open(with_images({"a.png", "a.png"}));
  const json after = rewrite({}, true);
  ASSERT_EQ(after["bufferViews"].size(), 1U);
  EXPECT_EQ(after["bufferViews"][0]["byteLength"], png.size());
  for (const json& image : after["images"])
    EXPECT_EQ(image, json({{"name", "picture"}, {"bufferView", 0}, {"mimeType", "image/png"}}));
  EXPECT_TRUE(losses_.empty());
}

TEST_F(GltfRewrite, ImagesThatCannotBeReadAreNamed) {
  TempFolder other;
  const auto outside = other.write("secret.png", "\x89PNG");
  for (const std::string& uri : {std::string("missing.png"), std::string("../x.png"),
                                 outside.string(), std::string("http://example.com/a.png")}) {
    open(with_images({uri}));
    const json after = rewrite({});
    EXPECT_EQ(after["images"][0]["uri"], uri);
    ASSERT_EQ(losses_.size(), 1U) << uri;
    const char* const reason = uri.starts_with("http") ? "mesher does not fetch from the network"
                                                       : "missing or outside the folder";
    EXPECT_NE(losses_[0].find(reason), std::string::npos) << losses_[0];
  }
}

TEST_F(GltfRewrite, ExtensionsOfEditedPrimitivesAreNamed) {
  GltfDocument file;
  file.floats(test::kSquareCorners, "VEC3", 3);
  file.indices(test::kSquareIndices);
  open(file.text(R"("extensionsUsed":["VENDOR_x","KHR_materials_variants"],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,
      "extensions":{"VENDOR_x":{},"KHR_materials_variants":{"mappings":[]}}}]}])"));
  const json after = rewrite(std::vector{edit_of(meshes_[0])});
  EXPECT_EQ(after["meshes"][0]["primitives"][0]["extensions"],
            json({{"KHR_materials_variants", {{"mappings", json::array()}}}}));
  EXPECT_EQ(after["extensionsUsed"], json({"KHR_materials_variants"}));
  EXPECT_EQ(losses_, std::vector<std::string>{"the extension VENDOR_x of edited meshes"});
}

// A mesh that is read again from compressed data is the same within the promised bounds.
TEST_F(GltfRewrite, CompressesEditedMeshes) {
  open(test::scene_file());
  const Model before = meshes_[0].model;
  {
    const GltfRewriter rewriter(scene_->document(), std::vector{edit_of(meshes_[0])}, true);
    AtomicFile file(folder_ / "out.glb");
    rewriter.write(file, true);
    file.commit();
  }
  GltfScene again(folder_ / "out.glb");
  const json document = again.document().root();
  EXPECT_EQ(document["extensionsRequired"],
            json({"EXT_meshopt_compression", "KHR_mesh_quantization"}));
  EXPECT_EQ(document["buffers"].size(), 2U);
  EXPECT_EQ(document["animations"], json::parse(test::scene_file())["animations"]);
  const Model after = again.read_meshes().at(0).model;
  ASSERT_EQ(after.mesh.face_count(), before.mesh.face_count());
  ASSERT_EQ(after.mesh.vertex_count(), before.mesh.vertex_count());
  for (std::uint32_t v = 0; v < after.mesh.vertex_count(); ++v)
    EXPECT_LT(glm::distance(after.mesh.position(Vertex(v)), before.mesh.position(Vertex(v))),
              2e-4F);
  // Written again without --compress, it is stored plainly.
  const std::vector<GltfSceneMesh> meshes = again.read_meshes();
  const GltfRewriter plain(again.document(), std::vector{edit_of(meshes[0])});
  AtomicFile file(folder_ / "plain.glb");
  plain.write(file, true);
  file.commit();
  GltfScene last(folder_ / "plain.glb");
  EXPECT_FALSE(has_extension(last.document().root(), "EXT_meshopt_compression"));
}

TEST_F(GltfRewrite, DeepDocumentsAreRefused) {
  std::string deep;
  for (int i = 0; i < 100000; ++i)
    deep += '[';
  deep += std::string(100000, ']');
  open(R"({"asset":{"version":"2.0"},"extras":)" + deep + "}");
  EXPECT_THROW(rewrite({}), InputError);
}

TEST_F(GltfRewrite, WrongTypesAreRefused) {
  std::string text = test::scene_file();
  const std::string dust = R"({"name":"dust","mesh":1})";
  text.replace(text.find(dust), dust.size(), R"({"mesh":0,"extensions":7,"children":5})");
  // The node is in no scene, so nothing has looked at it before.
  open(text);
  const GltfLevel level{&meshes_[0].model.mesh, &meshes_[0].model.attributes};
  const GltfMeshEdit edit{.mesh = 0, .levels = {level, level}};
  EXPECT_THROW(rewrite(std::span(&edit, 1)), InputError);
}

TEST_F(GltfRewrite, MissingBuffersAreRefused) {
  open(R"({"asset":{"version":"2.0"},"buffers":[{"uri":"gone.bin","byteLength":4}],
    "bufferViews":[{"buffer":0,"byteLength":4}]})");
  EXPECT_THROW(rewrite({}), InputError);
}

TEST_F(GltfRewrite, DocumentWithoutDataStaysSo) {
  open(R"({"asset":{"version":"2.0"},"nodes":[{"name":"n"}]})");
  for (const bool binary : {false, true})
    EXPECT_EQ(rewrite({}, binary),
              json::parse(R"({"asset":{"version":"2.0"},"nodes":[{"name":"n"}]})"));
}

TEST_F(GltfRewrite, CancelsWithoutAFile) {
  open(test::scene_file());
  Progress canceled;
  canceled.cancel();
  EXPECT_THROW(GltfRewriter(scene_->document(), std::vector{edit_of(meshes_[0])}, false, &canceled),
               Cancelled);
}

// What only a replaced primitive uses is free.
TEST(GltfUses, ReplacedPrimitivesDoNotCount) {
  const TempFolder folder;
  GltfScene scene(folder.write("s.gltf", test::scene_file()));
  const auto uses =
      find_uses(scene.document(), [](std::size_t mesh, std::size_t) { return mesh == 0; });
  EXPECT_EQ(uses.accessors, (std::vector<bool>{true, false, false, false, true, true}));
  EXPECT_TRUE(has_extension(scene.document().root(), "KHR_materials_unlit"));
  EXPECT_FALSE(has_extension(scene.document().root(), "KHR_texture_transform"));
}

}  // namespace
}  // namespace mesher::io
