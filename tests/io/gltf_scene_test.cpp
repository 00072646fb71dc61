#include "engine/io/gltf_scene.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "engine/core/progress.h"
#include "engine/io/gltf_rewrite.h"
#include "tests/support/gltf_scene_file.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using test::TempFolder;

TEST(GltfScene, CountsPlacementsOfEachMesh) {
  const TempFolder folder;
  GltfScene scene(folder.write("s.gltf", test::scene_file()));
  const std::vector<GltfSceneMesh> meshes = scene.read_meshes();
  ASSERT_EQ(meshes.size(), 1U);  // points are no mesh to edit
  EXPECT_EQ(meshes[0].index, 0U);
  EXPECT_EQ(meshes[0].placements, 2U);
  EXPECT_EQ(meshes[0].scale, 2.0);
  const Box box = scene.bounds(meshes);
  EXPECT_EQ(box.min, glm::vec3(10, 0, 0));
  EXPECT_EQ(box.max, glm::vec3(14, 2, 0));
  EXPECT_EQ(scene.contents()[Content::materials], 2U);
}

TEST(GltfScene, OutlivesTheProgressOfItsOpening) {
  const TempFolder folder;
  Progress opening;
  GltfScene scene(folder.write("s.gltf", test::scene_file()), {.progress = &opening});
  opening.cancel();  // a report to it would throw
  EXPECT_NO_THROW(scene.read_meshes());
  EXPECT_NO_THROW(GltfRewriter(scene.document(), {}));
  EXPECT_THROW(scene.read_meshes({.progress = &opening}), Cancelled);
}

TEST(GltfScene, WithoutNodesMeshesStandAlone) {
  test::GltfDocument file;
  file.floats(test::kSquareCorners, "VEC3", 3);
  file.indices(test::kSquareIndices);
  const TempFolder folder;
  GltfScene scene(folder.write(
      "s.gltf",
      file.text(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])")));
  const std::vector<GltfSceneMesh> meshes = scene.read_meshes();
  ASSERT_EQ(meshes.size(), 1U);
  EXPECT_EQ(meshes[0].placements, 0U);
  EXPECT_EQ(meshes[0].scale, 1.0);
  EXPECT_EQ(scene.bounds(meshes).max, glm::vec3(1, 1, 0));
}

TEST(GltfScene, RefusesMissingMeshesAndCycles) {
  const TempFolder folder;
  const auto open = [&](const std::string& nodes) {
    GltfScene(folder.write("s.gltf", R"({"asset":{"version":"2.0"},"nodes":)" + nodes + "}"));
  };
  EXPECT_THROW(open(R"([{"mesh":0}])"), InputError);
  EXPECT_THROW(open(R"([{"children":[1]},{"children":[1]}])"), InputError);
  EXPECT_NO_THROW(open(R"([{"children":[1]},{}])"));
}

}  // namespace
}  // namespace mesher::io
