#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>
#include <string>

#include "engine/io/read.h"
#include "engine/io/write.h"
#include "tests/support/temp_folder.h"

// What we write is opened by a reader that is not ours.

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

TEST_P(Interchange, OthersReadOurFiles) {
  const TempFolder folder;
  const Model model = read_model(folder.write("in.obj", kBox));
  const Way way = GetParam();
  const std::string file = (folder / way.file).string();
  write_model(file, model.mesh, model.attributes, {.ascii = way.ascii});
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

}  // namespace
}  // namespace mesher
