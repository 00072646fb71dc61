#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/io/gltf_write.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "engine/mesh/corner_attributes.h"
#include "tests/support/temp_folder.h"

// An independent reader opens the files that mesher writes.

namespace mesher {
namespace {

using test::TempFolder;

const std::string kBox =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 2\nv 1 0 2\nv 1 1 2\nv 0 1 2.5\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
    "f 4/4/1 3/3/1 2/2/1 1/1/1\nf 5/1/1 6/2/1 7/3/1 8/4/1\nf 1/1/1 2/2/1 6/3/1 5/4/1\n"
    "f 2/1/1 3/2/1 7/3/1 6/4/1\nf 3/1/1 4/2/1 8/3/1 7/4/1\nf 4/1/1 1/2/1 5/3/1 8/4/1\n";

struct Way {
  const char* file;
  bool ascii;
};

class Interchange : public testing::TestWithParam<Way> {};

TEST_P(Interchange, AssimpReadsOurFiles) {
  const TempFolder folder;
  const Model model = io::read_model(folder.write("in.obj", kBox));
  const Way way = GetParam();
  const std::string file = (folder / way.file).string();
  io::write_model(file, model.mesh, model.attributes, {.ascii = way.ascii});
  Assimp::Importer importer;
  const aiScene* const scene = importer.ReadFile(file, 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, 1U);
  const aiMesh& mesh = *scene->mMeshes[0];
  ASSERT_EQ(mesh.mNumFaces, model.mesh.face_count());
  for (std::uint32_t f = 0; f < mesh.mNumFaces; ++f) {
    ASSERT_EQ(mesh.mFaces[f].mNumIndices, 3U);
    for (std::uint32_t c = 0; c < 3; ++c) {
      const aiVector3D& theirs = mesh.mVertices[mesh.mFaces[f].mIndices[c]];
      const glm::vec3& ours = model.mesh.position(model.mesh.origins()[3 * f + c]);
      EXPECT_EQ(glm::vec3(theirs.x, theirs.y, theirs.z), ours) << f;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, Interchange,
                         testing::Values(Way{"m.obj", false}, Way{"m.ply", false},
                                         Way{"m.ply", true}, Way{"m.stl", false},
                                         Way{"m.stl", true}, Way{"m.off", false},
                                         Way{"m.glb", false}, Way{"m.gltf", false}),
                         [](const auto& parameter) {
                           std::string name(parameter.param.file + 2);
                           return name + (parameter.param.ascii ? "_ascii" : "");
                         });

/// A strip of the given number of triangles.
Mesh strip(std::uint32_t triangles) {
  Soup soup;
  for (std::uint32_t i = 0; i < triangles + 2; ++i)
    soup.positions.push_back({0.5F * float(i), float(i % 2), 0.0F});
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const bool is_odd = i % 2 != 0;
    for (const std::uint32_t v : {i, i + (is_odd ? 2U : 1U), i + (is_odd ? 1U : 2U)})
      soup.corners.push_back(v);
  }
  return build_mesh(std::move(soup)).mesh;
}

TEST(Levels, AssimpReadsAndShowsTheFinestLevel) {
  const TempFolder folder;
  const std::vector<Mesh> meshes{strip(8), strip(5), strip(2)};
  std::vector<Attributes> attributes(3);
  CornerAttributes halves;
  for (const glm::vec2 at : {glm::vec2(0, 0), glm::vec2(1, 0)})
    halves.texcoord.insert(halves.texcoord.end(), 12, at);
  attributes[0] = to_wedges(meshes[0], std::move(halves));
  const std::vector<io::GltfLevel> levels{{&meshes[0], &attributes[0], 0.5},
                                          {&meshes[1], &attributes[1], 0.125},
                                          {&meshes[2], &attributes[2], 0.0}};
  for (const char* name : {"l.glb", "l.gltf"}) {
    io::AtomicFile file(folder / name);
    io::write_gltf(file, levels, {.binary = std::string_view(name) == "l.glb"});
    file.commit();
    EXPECT_EQ(io::read_model(folder / name).mesh.face_count(), 8U);
    Assimp::Importer importer;
    const aiScene* const scene = importer.ReadFile((folder / name).string(), 0);
    ASSERT_NE(scene, nullptr) << importer.GetErrorString();
    ASSERT_EQ(scene->mNumMeshes, 1U);
    EXPECT_EQ(scene->mMeshes[0]->mNumFaces, 8U);
  }
  // If the scene lists all levels, the reader loads all levels.
  auto json = nlohmann::json::parse(test::read_bytes(folder / "l.gltf"));
  json["scenes"][0]["nodes"] = {0, 1, 2};
  Assimp::Importer importer;
  const aiScene* const scene = importer.ReadFile(folder.write("all.gltf", json.dump()).string(), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, 3U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    ASSERT_EQ(scene->mMeshes[i]->mNumFaces, meshes[i].face_count());
    const aiFace& last = scene->mMeshes[i]->mFaces[meshes[i].face_count() - 1];
    const aiVector3D& theirs = scene->mMeshes[i]->mVertices[last.mIndices[2]];
    const glm::vec3 ours = meshes[i].position(meshes[i].origins().back());
    EXPECT_EQ(glm::vec3(theirs.x, theirs.y, theirs.z), ours);
  }
}

TEST(Levels, FirstNodeListsTheOtherLevels) {
  const TempFolder folder;
  const Mesh mesh = strip(3);
  const Attributes none;
  const std::vector<io::GltfLevel> levels{{&mesh, &none, 0.5}, {&mesh, &none, 0.125}};
  io::AtomicFile file(folder / "l.gltf");
  io::write_gltf(file, levels, {});
  file.commit();
  const auto json = nlohmann::json::parse(test::read_bytes(folder / "l.gltf"));
  EXPECT_EQ(json["extensionsUsed"], nlohmann::json::array({"MSFT_lod"}));
  EXPECT_EQ(json["scenes"][0]["nodes"], nlohmann::json::array({0}));
  ASSERT_EQ(json["nodes"].size(), 2U);
  EXPECT_EQ(json["nodes"][0]["extensions"]["MSFT_lod"]["ids"], nlohmann::json::array({1}));
  EXPECT_EQ(json["nodes"][0]["extras"]["MSFT_screencoverage"], nlohmann::json({0.5, 0.125}));
  EXPECT_EQ(json["nodes"][1]["mesh"], 1);
  EXPECT_FALSE(json["nodes"][1].contains("extensions"));
  // A model with one level is written as before.
  io::AtomicFile single(folder / "s.gltf");
  io::write_gltf(single, std::span(levels).first(1), {});
  single.commit();
  EXPECT_EQ(test::read_bytes(folder / "s.gltf").find("MSFT"), std::string::npos);
}

}  // namespace
}  // namespace mesher
