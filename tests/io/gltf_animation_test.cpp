#include "engine/io/gltf_animation.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "engine/core/error.h"
#include "engine/io/read.h"
#include "tests/support/bytes.h"
#include "tests/support/gltf_document.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using scene::Animation;
using scene::Interpolation;
using scene::NodeProperty;
using test::bytes_of;
using test::GltfDocument;
using test::TempFolder;

constexpr int kTimes = 2;         // accessors of `animated_square`
constexpr int kTranslations = 3;  // from 0 to 2 along x in 2 seconds

/// A square with accessors for an animation of two keys.
GltfDocument animated_square() {
  GltfDocument document;
  document.floats(test::kSquareCorners, "VEC3", 3);
  document.indices(test::kSquareIndices);
  document.floats({1, 3}, "SCALAR", 1);
  document.floats({0, 0, 0, 2, 0, 0}, "VEC3", 3);
  return document;
}

constexpr const char* kPlainMesh =
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])";

std::string animation_json(const std::string& name, const std::string& channels,
                           const std::string& samplers) {
  return R"({"name":")" + name + R"(","channels":[)" + channels + R"(],"samplers":[)" + samplers +
         "]}";
}

std::string channel(int sampler, int node, const std::string& path) {
  return R"({"sampler":)" + std::to_string(sampler) + R"(,"target":{"node":)" +
         std::to_string(node) + R"(,"path":")" + path + "\"}}";
}

std::string sampler(int input, int output, const std::string& interpolation = "LINEAR") {
  return R"({"input":)" + std::to_string(input) + R"(,"output":)" + std::to_string(output) +
         R"(,"interpolation":")" + interpolation + "\"}";
}

/// The members of a document with a node that holds the mesh.
std::string animated_members(const std::string& animations,
                             const std::string& node = R"({"mesh":0})",
                             const std::string& mesh = kPlainMesh) {
  return R"("nodes":[)" + node + R"(],"animations":[)" + animations + "]," + mesh;
}

const std::string kMove =
    animation_json("Move", channel(0, 0, "translation"), sampler(kTimes, kTranslations));

std::vector<Animation> animations_of(const std::string& text) {
  const TempFolder folder;
  const MappedFile file(folder.write("m.gltf", text));
  GltfFile gltf(file, nullptr);
  return read_gltf_animations(gltf);
}

Soup posed(const std::string& text, const std::string& name, double time_s) {
  const TempFolder folder;
  return read_soup(folder.write("m.gltf", text),
                   {.pose = PoseChoice{.animation = name, .time_s = time_s}});
}

template <class Read>
std::string refusal_reason(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.reason();
  }
  return "was not refused";
}

std::string animations_refusal(const std::string& text) {
  return refusal_reason([&] { animations_of(text); });
}

std::string pose_refusal(const std::string& text, const std::string& name) {
  return refusal_reason([&] { posed(text, name, 0.0); });
}

TEST(GltfAnimation, ReadsKeysOfEachProperty) {
  GltfDocument document = animated_square();
  const int spline = document.floats(std::vector<float>(18, 1.0F), "VEC3", 3);
  const std::string text = document.text(animated_members(
      animation_json(
          "A", channel(0, 0, "translation") + "," + channel(1, 0, "scale"),
          sampler(kTimes, kTranslations, "STEP") + "," + sampler(kTimes, spline, "CUBICSPLINE")) +
      R"(,{"channels":[],"samplers":[]})"));
  const std::vector<Animation> animations = animations_of(text);
  ASSERT_EQ(animations.size(), 2U);
  EXPECT_EQ(animations[0].name, "A");
  EXPECT_EQ(animations[0].duration_s, 3.0);
  ASSERT_EQ(animations[0].channels.size(), 2U);
  const scene::Channel& first = animations[0].channels[0];
  EXPECT_EQ(first.property, NodeProperty::translation);
  EXPECT_EQ(first.interpolation, Interpolation::step);
  EXPECT_EQ(first.times, (std::vector<float>{1, 3}));
  EXPECT_EQ(first.values, (std::vector<float>{0, 0, 0, 2, 0, 0}));
  EXPECT_EQ(first.components, 3U);
  EXPECT_EQ(animations[0].channels[1].property, NodeProperty::scale);
  EXPECT_EQ(animations[0].channels[1].interpolation, Interpolation::cubic_spline);
  EXPECT_EQ(animations[0].channels[1].values.size(), 18U);
  EXPECT_EQ(animations[1].name, "");
  EXPECT_EQ(animations[1].duration_s, 0.0);
  EXPECT_TRUE(animations_of(document.text(kPlainMesh)).empty());
}

TEST(GltfAnimation, ReadsNormalizedAndSparseValues) {
  GltfDocument document = animated_square();
  const int view = document.view(bytes_of<std::int16_t>({0, 0, 0, 32767, 0, 0, -32767, 0}));
  const int turns = document.accessor(R"("normalized":true,"bufferView":)" + std::to_string(view),
                                      5122, "VEC4", 2);
  const int sparse = document.accessor(
      R"("sparse":{"count":1,"indices":{"bufferView":)" + std::to_string(document.view("\1")) +
          R"(,"componentType":5121},"values":{"bufferView":)" +
          std::to_string(document.view(bytes_of<float>({4, 5, 6}))) + "}}",
      5126, "VEC3", 2);
  const auto animations = animations_of(document.text(animated_members(
      animation_json("A", channel(0, 0, "rotation") + "," + channel(1, 0, "translation"),
                     sampler(kTimes, turns) + "," + sampler(kTimes, sparse)))));
  EXPECT_EQ(animations[0].channels[0].values, (std::vector<float>{0, 0, 0, 1, 0, 0, -1, 0}));
  EXPECT_EQ(animations[0].channels[0].components, 4U);
  EXPECT_EQ(animations[0].channels[1].values, (std::vector<float>{0, 0, 0, 4, 5, 6}));
}

TEST(GltfAnimation, ChannelsWithoutNodeOrOfUnknownPropertiesAreLeftOut) {
  const std::string pointer =
      R"({"sampler":9,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{}}}})";
  const auto animations = animations_of(animated_square().text(animated_members(
      animation_json("A",
                     R"({"sampler":0,"target":{"path":"scale"}},)" + pointer + "," +
                         channel(0, 0, "visibility") + "," + channel(0, 0, "translation"),
                     sampler(kTimes, kTranslations)))));
  ASSERT_EQ(animations[0].channels.size(), 1U);
  EXPECT_EQ(animations[0].channels[0].property, NodeProperty::translation);
}

TEST(GltfAnimation, BrokenAnimationsAreRefused) {
  GltfDocument document = animated_square();
  const int equal = document.floats({1, 1}, "SCALAR", 1);
  const int nan = document.accessor(
      R"("bufferView":)" + std::to_string(document.view(bytes_of<std::uint32_t>({0, 0x7FC00000}))),
      5126, "SCALAR", 2);
  const int none = document.accessor(R"("bufferView":0)", 5126, "SCALAR", 0);
  const int three = document.floats(std::vector<float>(9, 1.0F), "VEC3", 3);
  const auto refusal = [&](const std::string& channels, const std::string& samplers) {
    return animations_refusal(
        document.text(animated_members(animation_json("A", channels, samplers))));
  };
  const std::string move = channel(0, 0, "translation");
  const std::string lengths = "an animation's times and values have different lengths";
  const std::string rise = "the times of an animation do not rise";
  EXPECT_EQ(refusal(move, sampler(equal, kTranslations)), rise);
  EXPECT_EQ(refusal(move, sampler(nan, kTranslations)), rise);
  EXPECT_EQ(refusal(move, sampler(none, kTranslations)), "an animation has no keys");
  EXPECT_EQ(refusal(move, sampler(kTimes, three)), lengths);
  EXPECT_EQ(refusal(move, sampler(kTimes, kTranslations, "CUBICSPLINE")), lengths);
  EXPECT_EQ(refusal(channel(0, 0, "weights"), sampler(kTimes, kTimes)), lengths)
      << "the mesh has no targets";
  EXPECT_EQ(refusal(channel(0, 0, "rotation"), sampler(kTimes, kTranslations)),
            "an animation's accessor has the wrong type");
  EXPECT_EQ(refusal(move, sampler(kTranslations, kTranslations)),
            "an animation's accessor has the wrong type");
  EXPECT_EQ(refusal(move, sampler(kTimes, kTranslations, "QUINTIC")),
            "an animation has an unknown interpolation");
  EXPECT_EQ(refusal(move, sampler(kTimes, 99)), "index into accessors out of range");
  EXPECT_EQ(refusal(channel(0, 7, "scale"), sampler(kTimes, kTranslations)),
            "index into nodes out of range");
  EXPECT_EQ(refusal(channel(1, 0, "scale"), sampler(kTimes, kTranslations)),
            "a channel's sampler is out of range");
  EXPECT_EQ(refusal(move, R"({"output":3})"), "an animation has no input");
  EXPECT_EQ(refusal(move, "7"), "an animation has no input");
  EXPECT_EQ(refusal("7", ""), "a channel has no target");
  EXPECT_EQ(animations_refusal(document.text(animated_members(R"({"channels":[]})"))),
            "an animation has no samplers");
  EXPECT_EQ(animations_refusal(document.text(animated_members("7"))),
            "an element of animations is not an object");
}

// Each channel would copy the same keys.
TEST(GltfAnimation, RepeatedKeysAreBoundedByTheSizeOfTheFile) {
  constexpr int kKeys = 20000;
  constexpr int kChannels = 1000;
  GltfDocument document = animated_square();
  std::vector<float> times(kKeys);
  for (int i = 0; i < kKeys; ++i)
    times[static_cast<std::size_t>(i)] = static_cast<float>(i);
  const int input = document.floats(times, "SCALAR", 1);
  const int output = document.floats(std::vector<float>(3 * kKeys, 1.0F), "VEC3", 3);
  std::string channels = channel(0, 0, "scale");
  for (int i = 1; i < kChannels; ++i)
    channels += "," + channel(0, 0, "scale");
  EXPECT_EQ(animations_refusal(document.text(
                animated_members(animation_json("A", channels, sampler(input, output))))),
            "its animations repeat their data too often for the size of the file");
}

TEST(GltfAnimation, PoseMovesNodes) {
  const std::string text = animated_square().text(animated_members(kMove));
  const auto corner = [&](double time_s) { return posed(text, "Move", time_s).positions[0]; };
  EXPECT_EQ(corner(0.0), glm::vec3(0, 0, 0));
  EXPECT_EQ(corner(1.5), glm::vec3(0.5F, 0, 0));
  EXPECT_EQ(corner(9.0), glm::vec3(2, 0, 0));
  EXPECT_EQ(posed(text, "0", 2.0).positions[0], glm::vec3(1, 0, 0)) << "by index";
}

TEST(GltfAnimation, PropertiesThatAreNotAnimatedStay) {
  const std::string text = animated_square().text(
      animated_members(kMove, R"({"mesh":0,"translation":[9,9,9],"scale":[2,3,4]})"));
  EXPECT_EQ(posed(text, "Move", 2.0).positions[2], glm::vec3(3, 3, 0));
  const std::string matrix = R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,7,7,7,1]})";
  EXPECT_EQ(
      posed(animated_square().text(animated_members(kMove, matrix)), "Move", 2.0).positions[0],
      glm::vec3(1, 0, 0))
      << "an animated node has no matrix";
  const std::string idle =
      animated_square().text(animated_members(animation_json("Idle", "", ""), matrix));
  EXPECT_EQ(posed(idle, "Idle", 2.0).positions[0], glm::vec3(7, 7, 7));
}

TEST(GltfAnimation, PoseSetsWeightsOfMorphTargets) {
  GltfDocument document = animated_square();
  document.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  document.floats({4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3", 3);
  const int weights = document.floats({0, 0, 1, 0.5F}, "SCALAR", 1);
  const std::string text = document.text(animated_members(
      animation_json("Morph", channel(0, 0, "weights"), sampler(kTimes, weights)),
      R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,7,0,1]})",
      R"("meshes":[{"weights":[1,1],"primitives":[{"attributes":{"POSITION":0},"indices":1,
              "targets":[{"POSITION":4},{"POSITION":5}]}]}])"));
  EXPECT_EQ(posed(text, "Morph", 0.0).positions[0], glm::vec3(0, 7, 0)) << "the matrix stays";
  EXPECT_EQ(posed(text, "Morph", 2.0).positions[0], glm::vec3(1, 7, 0.5F));
}

TEST(GltfAnimation, PoseMovesJoints) {
  GltfDocument document = animated_square();
  const int joints = document.accessor(
      R"("bufferView":)" + std::to_string(document.view(std::string(16, '\0'))), 5121, "VEC4", 4);
  const int weights = document.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
  const std::string text = document.text(animated_members(
      animation_json("Wave", channel(0, 1, "translation"), sampler(kTimes, kTranslations)),
      R"({"mesh":0,"skin":0},{"translation":[0,5,0]})",
      R"("skins":[{"joints":[1]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,
              "JOINTS_0":)" +
          std::to_string(joints) + R"(,"WEIGHTS_0":)" + std::to_string(weights) +
          R"(},"indices":1}]}])"));
  EXPECT_EQ(posed(text, "Wave", 2.0).positions[0], glm::vec3(1, 0, 0));
}

TEST(GltfAnimation, PoseFarFromZeroKeepsItsDigits) {
  GltfDocument document = animated_square();
  const int far = document.floats({0, 0, 0, 2e8F, 0, 0}, "VEC3", 3);
  const Soup soup = posed(document.text(animated_members(animation_json(
                              "Go", channel(0, 0, "translation"), sampler(kTimes, far)))),
                          "Go", 3.0);
  EXPECT_NE(soup.origin, glm::dvec3(0.0));
  EXPECT_EQ(soup.origin.x + double(soup.positions[1].x), 200000001.0);
}

TEST(GltfAnimation, NamesCountBeforeIndices) {
  const std::string still =
      animation_json("0", channel(0, 0, "scale"), sampler(kTimes, kTranslations));
  const std::string text = animated_square().text(animated_members(kMove + "," + still));
  EXPECT_EQ(posed(text, "1", 3.0).positions[1], glm::vec3(2, 0, 0)) << "scaled";
  EXPECT_EQ(posed(text, "0", 3.0).positions[1], glm::vec3(2, 0, 0)) << "scaled";
  EXPECT_EQ(posed(text, "Move", 3.0).positions[1], glm::vec3(3, 0, 0));
}

TEST(GltfAnimation, OtherAnimationsMayBeBroken) {
  const std::string text = animated_square().text(animated_members(
      kMove + "," + animation_json("Broken", channel(0, 0, "scale"), sampler(99, 99))));
  EXPECT_EQ(posed(text, "Move", 3.0).positions[0], glm::vec3(2, 0, 0));
  EXPECT_EQ(pose_refusal(text, "Broken"), "index into accessors out of range");
}

TEST(GltfAnimation, UnknownNamesListTheAnimations) {
  const std::string unnamed = R"({"channels":[],"samplers":[]})";
  const std::string text = animated_square().text(animated_members(kMove + "," + unnamed));
  EXPECT_EQ(pose_refusal(text, "Jump"),
            R"(has no animation "Jump"; its animations are 0 "Move", 1 "")");
  EXPECT_EQ(pose_refusal(text, "2"), R"(has no animation "2"; its animations are 0 "Move", 1 "")");
  EXPECT_EQ(pose_refusal(text, ""), R"(its animations are 0 "Move", 1 "")");
  EXPECT_EQ(pose_refusal(animated_square().text(kPlainMesh), "Jump"), "has no animations");
  std::string many = animation_json(std::string(500, 'x') + R"(\n)", "", "");
  for (int i = 0; i < 100; ++i)
    many += "," + animation_json("a\\nb", "", "");
  const std::string refusal = pose_refusal(animated_square().text(animated_members(many)), "Jump");
  EXPECT_LT(refusal.size(), 1500U);
  EXPECT_EQ(refusal.find('\n'), std::string::npos);
  EXPECT_TRUE(refusal.ends_with(R"(63 "a\nb", ...)")) << refusal;
}

TEST(GltfAnimation, FormatsWithoutAnimationsAreRefused) {
  const TempFolder folder;
  const auto file = folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(refusal_reason([&] { read_soup(file, {.pose = PoseChoice{}}); }), "has no animations");
}

}  // namespace
}  // namespace mesher::io
