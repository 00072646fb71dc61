// Tests compressed glTF files of models from other formats.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/io/gltf_write.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using nlohmann::json;
using test::corners_of;
using test::TempFolder;

const std::string kImage = "\x89PNG\r\n\x1A\nsome";

/// Two materials with an image, texture coordinates with a seam, and normals; far from zero.
Model textured(const TempFolder& folder) {
  folder.write("a.png", kImage);
  folder.write("in.mtl", "newmtl red\nmap_Kd a.png\nnewmtl blue\nKd 0 0 1\n");
  return read_model(folder.write(
      "in.obj",
      "mtllib in.mtl\nv 5000000.1 0 0\nv 5000001.1 0 0\nv 5000001.1 1 0\nv 5000000.1 1 0.5\n"
      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0.3 1\nvt 0.25 0\nvn 0 0 1\nvn 0 0.6 0.8\n"
      "usemtl red\nf 1/1/1 2/2/1 3/3/1\nusemtl blue\nf 1/5/1 3/3/2 4/4/2\n"));
}

WriteOptions compressed(const Model& model) {
  return {.compresses = true, .origin = model.origin, .materials = model.materials};
}

TEST(GltfCompressedWrite, ComesBackWithinTheBounds) {
  const TempFolder folder;
  const Model model = textured(folder);
  const CornerAttributes before = corners_of(model);
  for (const char* name : {"o.glb", "o.gltf"}) {
    SCOPED_TRACE(name);
    write_model(folder / name, model.mesh, model.attributes, compressed(model));
    const Model back = read_model(folder / name);
    EXPECT_TRUE(back.contents.warnings().empty());
    EXPECT_EQ(back.origin, model.origin);
    ASSERT_EQ(back.mesh.face_count(), 2U);
    ASSERT_EQ(back.mesh.vertex_count(), 4U);
    const CornerAttributes after = corners_of(back);
    for (std::uint32_t f = 0; f < 2; ++f) {
      // A triangle may begin at another corner.
      std::uint32_t turn = 0;
      const auto at = [&](std::uint32_t c) { return Halfedge(3 * f + (c + turn) % 3); };
      const auto apart = [&](std::uint32_t c) {
        return glm::distance(back.mesh.position(back.mesh.origin(at(c))),
                             model.mesh.position(model.mesh.origin(Halfedge(3 * f + c))));
      };
      while (turn < 3 && apart(0) > 1e-3F)
        ++turn;
      for (std::uint32_t c = 0; c < 3; ++c) {
        EXPECT_LT(apart(c), 1.0F / 32768.0F);
        const std::size_t to = at(c).index();
        EXPECT_LT(glm::distance(after.texcoord[to], before.texcoord[3 * f + c]), 1.0F / 32768.0F);
        EXPECT_LT(glm::distance(after.normal[to], before.normal[3 * f + c]), 0.02F);
      }
    }
    ASSERT_EQ(back.materials->materials.size(), 2U);
    EXPECT_EQ(*back.materials->images[0].bytes, kImage);
    for (std::size_t f = 0; f < 2; ++f) {
      const std::uint32_t material = back.attributes.groups[back.attributes.group[f]].material;
      EXPECT_EQ(back.materials->materials[material].name, f == 0 ? "red" : "blue");
    }
  }
}

TEST(GltfCompressedWrite, NamesItsExtensionsAndItsFallback) {
  const TempFolder folder;
  const Model model = textured(folder);
  write_model(folder / "o.gltf", model.mesh, model.attributes, compressed(model));
  const json document = json::parse(test::read_bytes(folder / "o.gltf"));
  const json names = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
  EXPECT_EQ(document["extensionsUsed"], names);
  EXPECT_EQ(document["extensionsRequired"], names);
  ASSERT_EQ(document["buffers"].size(), 2U);
  EXPECT_EQ(document["buffers"][1]["extensions"]["EXT_meshopt_compression"]["fallback"], true);
  EXPECT_FALSE(document["buffers"][1].contains("uri"));
  const std::size_t length = document["buffers"][0]["byteLength"];
  const std::size_t decoded = document["buffers"][1]["byteLength"];
  for (const json& view : document["bufferViews"]) {
    const bool is_image = !view.contains("target");
    const json& place = is_image ? view : view["extensions"]["EXT_meshopt_compression"];
    EXPECT_EQ(place["buffer"], 0);
    EXPECT_LE(place["byteOffset"].get<std::size_t>() + place["byteLength"].get<std::size_t>(),
              length);
    if (is_image) continue;
    EXPECT_EQ(view["buffer"], 1);
    EXPECT_LE(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>(),
              decoded);
  }
}

TEST(GltfCompressedWrite, LevelsAreCompressedToo) {
  const TempFolder folder;
  const Mesh fine = test::built(test::torus(60, 40)).mesh;
  const Mesh coarse = test::built(test::torus(12, 8)).mesh;
  const Attributes none;
  const GltfLevel levels[] = {{&fine, &none, 0.5}, {&coarse, &none, 0.0}};
  for (const bool compresses : {false, true}) {
    AtomicFile file(folder / (compresses ? "small.glb" : "plain.glb"));
    write_gltf(file, levels, {.binary = true, .compresses = compresses});
    file.commit();
  }
  EXPECT_LT(3 * test::read_bytes(folder / "small.glb").size(),
            2 * test::read_bytes(folder / "plain.glb").size());
  const Model back = read_model(folder / "small.glb");
  EXPECT_EQ(back.mesh.face_count(), fine.face_count());
  EXPECT_EQ(back.mesh.vertex_count(), fine.vertex_count());
}

TEST(GltfCompressedWrite, BytesDoNotDependOnThreads) {
  const TempFolder folder;
  const Mesh mesh = test::built(test::torus(60, 40)).mesh;
  std::string bytes[2];
  for (const unsigned threads : {1U, 2U}) {
    const ThreadLimit limit(threads);
    write_model(folder / "o.glb", mesh, {}, {.compresses = true});
    bytes[threads - 1] = test::read_bytes(folder / "o.glb");
  }
  EXPECT_EQ(bytes[0], bytes[1]);
}

TEST(GltfCompressedWrite, CancelLeavesNothing) {
  const TempFolder folder;
  Progress progress;
  progress.cancel();
  EXPECT_THROW(write_model(folder / "o.glb", test::built(test::cube()).mesh, {},
                           {.compresses = true, .progress = &progress}),
               Cancelled);
  EXPECT_FALSE(std::filesystem::exists(folder / "o.glb"));
}

}  // namespace
}  // namespace mesher::io
