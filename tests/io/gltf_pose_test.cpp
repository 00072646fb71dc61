#include "engine/io/gltf_pose.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/core/error.h"
#include "engine/io/read.h"
#include "tests/support/gltf_document.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using test::GltfDocument;
using test::kSquareCorners;
using test::kSquareIndices;
using test::TempFolder;

Soup read_document(const std::string& text) {
  const TempFolder folder;
  return read_soup(folder.write("m.gltf", text));
}

std::string refusal_of(const std::string& text) {
  try {
    read_document(text);
  } catch (const InputError& error) {
    return error.reason();
  }
  return "was not refused";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string mesh_of(const std::string& attributes, const std::string& more = "") {
  return R"("meshes":[{"primitives":[{"attributes":{"POSITION":0)" + attributes +
         R"(},"indices":1)" + more + "}]}]";
}

GltfDocument square() {
  GltfDocument document;
  document.floats(kSquareCorners, "VEC3", 3);
  document.indices(kSquareIndices);
  return document;
}

// glTF: the transform of a skinned node does not count, that of the joints does.
TEST(GltfPose, JointsPlaceSkinnedVertices) {
  GltfDocument document = square();
  document.accessor(R"("bufferView":)" + std::to_string(document.view(
                                             std::string("\0\0\0\0\0\0\0\0\1\0\0\0\0\1\0\0", 16))),
                    5121, "VEC4", 4);
  document.floats({1, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0.5F, 0.5F, 0, 0}, "VEC4", 4);
  const std::string mesh = mesh_of(R"(,"JOINTS_0":2,"WEIGHTS_0":3)");
  const std::string nodes =
      R"("nodes":[{"mesh":0,"skin":0,"scale":[100,100,100]},{"translation":[0,2,0],"children":[2]},
      {"translation":[10,0,0]}],"scenes":[{"nodes":[0,1]}],)";
  const Soup soup = read_document(document.text(nodes + R"("skins":[{"joints":[1,2]}],)" + mesh));
  ASSERT_EQ(soup.positions.size(), 4U);
  EXPECT_EQ(soup.positions[0], glm::vec3(0, 2, 0));
  EXPECT_EQ(soup.positions[1], glm::vec3(1, 2, 0));
  EXPECT_EQ(soup.positions[2], glm::vec3(11, 3, 0)) << "weights need not sum to 1";
  EXPECT_EQ(soup.positions[3], glm::vec3(5, 3, 0)) << "the mean of both joints";
  EXPECT_EQ(soup.contents[Content::skins], 1U);
  EXPECT_EQ(soup.contents[Content::joint_sets], 1U);

  std::vector<float> inverse;
  for (int joint = 0; joint < 2; ++joint) {
    for (const int value : {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, -2, 0, 1})
      inverse.push_back(float(value));
  }
  document.floats(inverse, "MAT4", 16);
  const Soup bound = read_document(
      document.text(nodes + R"("skins":[{"joints":[1,2],"inverseBindMatrices":4}],)" + mesh));
  EXPECT_EQ(bound.positions[1], glm::vec3(2, 0, 0));

  EXPECT_TRUE(contains(refusal_of(document.text(nodes + R"("skins":[{"joints":[1]}],)" + mesh)),
                       "a joint"));
  EXPECT_TRUE(contains(refusal_of(document.text(nodes + R"("skins":[{"joints":[1,9]}],)" + mesh)),
                       "out of range"));
  EXPECT_TRUE(contains(refusal_of(document.text(nodes + R"("skins":[{}],)" + mesh)), "no joints"));
  EXPECT_TRUE(contains(refusal_of(document.text(nodes + mesh)), "out of range"));
}

TEST(GltfPose, SkinWithoutJointsOnItsVerticesLeavesTheNodesTransform) {
  const Soup soup = read_document(square().text(
      R"("nodes":[{"mesh":0,"skin":0,"translation":[1,0,0]}],"skins":[{"joints":[0]}],)" +
      mesh_of("")));
  EXPECT_EQ(soup.positions[0], glm::vec3(1, 0, 0));
}

TEST(GltfPose, InstancesAreAllRead) {
  GltfDocument document = square();
  document.floats({0, 0, 0, 5, 0, 0, 0, 5, 0}, "VEC3", 3);
  document.floats({1, 1, 1, 2, 2, 2, 1, 1, -1}, "VEC3", 3);
  const auto nodes = [](const std::string& attributes) {
    return R"("extensionsRequired":["EXT_mesh_gpu_instancing"],"nodes":[{"mesh":0,"translation":[0,0,1],
      "extensions":{"EXT_mesh_gpu_instancing":{"attributes":{)" +
           attributes + "}}}}]," + mesh_of("");
  };
  const Soup soup = read_document(document.text(nodes(R"("TRANSLATION":2,"SCALE":3)")));
  EXPECT_EQ(soup.face_count(), 6U);
  ASSERT_EQ(soup.positions.size(), 12U);
  EXPECT_EQ(soup.positions[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(soup.positions[5], glm::vec3(7, 0, 1)) << "scaled, then moved, then by the node";
  EXPECT_EQ(soup.contents[Content::instances], 3U);
  EXPECT_EQ(read_document(document.text(nodes(R"("_OTHER":2)"))).face_count(), 2U);
  document.floats({0, 0, 0}, "VEC3", 3);
  EXPECT_TRUE(contains(refusal_of(document.text(nodes(R"("TRANSLATION":2,"SCALE":4)"))),
                       "different lengths"));
  EXPECT_TRUE(contains(refusal_of(document.text(nodes(R"("TRANSLATION":77)"))), "out of range"));
}

TEST(GltfPose, HostileNumbersOfInstancesAreRefused) {
  GltfDocument document = square();
  const std::string zero = std::to_string(document.view(std::string(12, '\0')));
  for (const std::size_t count : {std::size_t{600000}, std::size_t{4000000000}}) {
    GltfDocument many = document;
    many.accessor(R"("sparse":{"count":1,"indices":{"bufferView":)" + zero +
                      R"(,"componentType":5121},"values":{"bufferView":)" + zero + "}}",
                  5126, "VEC3", count);
    const std::string reason = refusal_of(many.text(
        R"("nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":2}}}}],)" +
        mesh_of("")));
    EXPECT_TRUE(contains(reason, "too often") || contains(reason, "too long")) << reason;
  }
}

TEST(GltfPose, DefaultWeightsOfMorphTargetsCount) {
  GltfDocument document = square();
  document.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  document.floats({4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3", 3);
  const std::string targets = R"(,"targets":[{"POSITION":2},{"POSITION":3}])";
  const auto first = [&](const std::string& node, const std::string& mesh) {
    const Soup soup =
        read_document(document.text(R"("nodes":[{"mesh":0)" + node +
                                    R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},
        "indices":1)" + targets + "}]" +
                                    mesh + "}]"));
    EXPECT_EQ(soup.contents[Content::morph_targets], 2U);
    return soup.positions[0];
  };
  EXPECT_EQ(first("", ""), glm::vec3(0, 0, 0));
  EXPECT_EQ(first("", R"(,"weights":[0.5,0.25])"), glm::vec3(1, 0, 0.5F));
  EXPECT_EQ(first(R"(,"weights":[1,0])", R"(,"weights":[0.5,0.25])"), glm::vec3(0, 0, 1));
}

}  // namespace
}  // namespace mesher::io
