// Compares images of real assets in every look with approved images (tests/golden).

#include <filesystem>
#include <string>
#include <vector>

#include "engine/io/image_decode.h"
#include "engine/io/read.h"
#include "engine/render/offscreen.h"
#include "tests/support/golden.h"
#include "tests/support/gpu_test.h"

namespace mesher::render {
namespace {

struct LookScene {
  std::string name;
  std::string file;  ///< in the folder of shared models
  Look look;
};

void PrintTo(const LookScene& scene, std::ostream* out) {
  *out << scene.name;
}

std::vector<LookScene> look_scenes() {
  std::vector<LookScene> scenes;
  for (const auto& [name, file] : {std::pair{"helmet", "DamagedHelmet.glb"},
                                   {"oaktree", "oaktree.gltf"},
                                   {"colors", "BoxVertexColors.glb"}}) {
    for (const Choice<Look>& choice : kLooks) {
      if (choice.value == Look::automatic) continue;
      std::string label = choice.text.key;
      std::ranges::replace(label, '-', '_');
      scenes.push_back({std::string("look_") + name + "_" + label, file, choice.value});
    }
  }
  return scenes;
}

class LookGolden : public test::GpuTest, public ::testing::WithParamInterface<LookScene> {};

TEST_P(LookGolden, MatchesTheApprovedImage) {
  const LookScene& scene = GetParam();
  const std::filesystem::path file =
      std::filesystem::path(MESHER_SHARED_MODELS) / "scenes" / scene.file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  Model model = io::read_model(file);
  std::vector<std::string> problems;
  Sources sources;
  sources.appearance = {.attributes = &model.attributes,
                        .materials = model.materials,
                        .decode = [&](std::span<const ImageRequest> images, const TakeImage& take) {
                          io::decode_images(*model.materials, images, take, problems);
                        }};
  Camera camera;
  camera.set_angles(0.5, 0.3);
  camera.frame(bounding_box(model.mesh), 1.0);
  constexpr std::uint32_t kSide = 320;
  const Image image =
      render_image(device(), model.mesh, camera, {.look = scene.look}, kSide, kSide, sources);
  test::expect_golden(device(), scene.name, image);
  EXPECT_TRUE(problems.empty());
}

INSTANTIATE_TEST_SUITE_P(Scenes, LookGolden, ::testing::ValuesIn(look_scenes()),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace mesher::render
