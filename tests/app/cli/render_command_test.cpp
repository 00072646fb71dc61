// Tests pictures of models at less than full detail.
#include "app/cli/render_command.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/io/png.h"
#include "tests/app/program_test.h"
#include "tests/support/gltf_document.h"
#include "tests/support/webp_file.h"

namespace mesher::test {
namespace {

using app::detail_moment;
using app::DetailMoment;

TEST(DetailMoment, RunsFromBaseToFullDetail) {
  const DetailMoment base = detail_moment(0.0, 80, 1600);
  EXPECT_EQ(base.level, 0U);
  EXPECT_EQ(base.time, 0.0);
  EXPECT_EQ(base.window, 10.0);
  double grown = 0.0;
  for (double lod = 0.01; lod < 1.0; lod += 0.01) {
    const DetailMoment moment = detail_moment(lod, 80, 1600);
    double now = 0.0;
    for (std::uint32_t i = 0; i < moment.level; ++i)
      now += double(growth(moment.growth, i));
    EXPECT_GT(now, grown);
    EXPECT_NEAR(now, lod * 1600, 130);  // half the largest number of splits that grow at a time
    grown = now;
  }
  const DetailMoment full = detail_moment(1.0, 80, 1600);
  EXPECT_EQ(full.level, 1600U);
  EXPECT_EQ(full.growth, GeomorphTime::done());
}

TEST(DetailMoment, MeshWithoutSplitsHasOneLevel) {
  for (const double lod : {0.0, 0.5, 1.0}) {
    EXPECT_EQ(detail_moment(lod, 80, 0).level, 0U);
    EXPECT_GT(detail_moment(lod, 80, 0).window, 0.0);
  }
}

class RenderCommand : public ProgramTest {
 protected:
  Image picture(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"-o", "r.png", "--size", "160", "--validation"});
    const Finished run = mesher(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return io::read_png(folder_ / "r.png");
  }
};

/// Mean absolute difference of the channels, 0 to 255.
double difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.rgba.size(), b.rgba.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    sum += std::abs(int(a.rgba[i]) - int(b.rgba[i]));
  return sum / double(a.rgba.size());
}

TEST_F(RenderCommand, LegendExplainsSharpnessAndSplitOrder) {
  const Image plain = picture({"knot", "--lod", "0.5"});
  const Image colored = picture({"knot", "--lod", "0.5", "--split-colors"});
  EXPECT_GT(difference(plain, colored), 1.0);
  const Image legend = picture({"knot", "--lod", "0.5", "--split-colors", "--legend"});
  EXPECT_GT(difference(legend, colored), 1.0);
  EXPECT_EQ(picture({"knot", "--legend"}).rgba, picture({"knot"}).rgba) << "nothing to explain";
  const Finished alone = mesher({"render", "knot", "-o", "r.png", "--split-colors"});
  EXPECT_EQ(alone.exit_code, 1) << "only levels have an order of splits";
}

TEST_F(RenderCommand, FullDetailEqualsModel) {
  const Image full = picture({"bunny"});
  EXPECT_LT(difference(picture({"bunny", "--lod", "1"}), full), 0.05);
  EXPECT_GT(difference(picture({"bunny", "--lod", "0"}), full), 0.5);
  EXPECT_LT(
      difference(picture({"bunny", "--lod", "1", "--gouraud"}), picture({"bunny", "--gouraud"})),
      0.5);
}

TEST_F(RenderCommand, PictureChangesContinuouslyWithLod) {
  const Image at = picture({"bunny", "--lod", "0.2"});
  const Image near = picture({"bunny", "--lod", "0.2003"});  // half a split further
  const Image far = picture({"bunny", "--lod", "0.6"});
  EXPECT_LT(difference(at, near), 0.2 * difference(at, far));
}

TEST_F(RenderCommand, ProgressiveFileGivesSamePicture) {
  ASSERT_EQ(mesher({"progressive", "bunny", "-o", "b.pm"}).exit_code, 0);
  EXPECT_TRUE(picture({"b.pm", "--lod", "0.37"}).rgba == picture({"bunny", "--lod", "0.37"}).rgba);
  EXPECT_EQ(
      mesher_json({"render", "b.pm", "-o", "r.png", "--size", "20", "--faces", "1001"})["faces"],
      1000);
}

TEST_F(RenderCommand, JsonReportsDetailMoment) {
  const auto json = mesher_json({"render", "bunny", "-o", "r.png", "--size", "20", "--lod", "0.5"});
  const DetailMoment moment = detail_moment(0.5, 102, 1737);
  EXPECT_EQ(json["detail"]["lod"], 0.5);
  EXPECT_EQ(json["detail"]["splits"], 1737);
  EXPECT_EQ(json["detail"]["level"], moment.level);
  EXPECT_EQ(json["detail"]["time"], moment.time);
  EXPECT_EQ(json["detail"]["window"], moment.window);
  EXPECT_EQ(json["faces"], 200 + 2 * moment.level);
  EXPECT_FALSE(json.contains("pm"));
}

TEST_F(RenderCommand, SmallModelsHaveLevels) {
  EXPECT_LT(difference(picture({"cube", "--lod", "1"}), picture({"cube"})), 0.05);
  EXPECT_GT(difference(picture({"cube", "--lod", "0"}), picture({"cube"})), 1.0);
}

TEST_F(RenderCommand, InvalidDetailIsRejected) {
  for (const char* lod : {"-0.1", "1.1", "nan", "inf", "", "x", "0.5x"})
    EXPECT_EQ(mesher({"render", "cube", "-o", "x.png", "--lod", lod}).exit_code, 1) << lod;
  EXPECT_EQ(mesher({"render", "cube", "-o", "x.png", "--lod", "1", "--faces", "6"}).exit_code, 1);
  ASSERT_EQ(mesher({"progressive", "cube", "-o", "c.pm"}).exit_code, 0);
  EXPECT_EQ(mesher({"render", "c.pm", "-o", "x.png", "--lod", "1", "--tag-creases", "9"}).exit_code,
            1);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.png"));
}

TEST_F(RenderCommand, ScaleMultipliesTheSize) {
  const Image once = picture({"creased_cube", "--wireframe"});
  const Image picture_x3 = picture({"creased_cube", "--wireframe", "--scale", "3"});
  EXPECT_EQ(once.width, 160U);
  EXPECT_EQ(picture_x3.width, 480U);
  ASSERT_EQ(mesher({"render", "creased_cube", "-o", "large.png", "--size", "480", "--wireframe"})
                .exit_code,
            0);
  EXPECT_GT(difference(picture_x3, io::read_png(folder_ / "large.png")), 0.2)
      << "the lines of a larger window are thinner";
  const auto json = mesher_json({"render", "cube", "-o", "r.png", "--size", "20x10", "--scale", "2",
                                 "--supersample", "3", "--transparent"});
  EXPECT_EQ(json["picture"]["size"], nlohmann::json({40, 20}));
  EXPECT_EQ(json["picture"]["scale"], 2);
  EXPECT_EQ(json["picture"]["supersample"], 3);
  EXPECT_EQ(json["picture"]["transparent"], true);
  EXPECT_FALSE(json.contains("turntable"));
}

TEST_F(RenderCommand, TransparentPictureHasNoBackground) {
  const Image opaque = picture({"cube"});
  const Image transparent = picture({"cube", "--transparent"});
  EXPECT_EQ(opaque.pixel(0, 0)[3], 255);
  EXPECT_EQ(transparent.pixel(0, 0)[3], 0);
  EXPECT_EQ(transparent.pixel(80, 80)[3], 255);
  EXPECT_TRUE(
      std::equal(opaque.pixel(80, 80), opaque.pixel(80, 80) + 4, transparent.pixel(80, 80)));
}

TEST_F(RenderCommand, OutputFormatFollowsTheEnding) {
  for (const char* lod : {"0.4", "1"}) {
    const Image png = picture({"bunny", "--supersample", "2", "--lod", lod});
    ASSERT_EQ(mesher({"render", "bunny", "-o", "r.webp", "--size", "160", "--supersample", "2",
                      "--lod", lod})
                  .exit_code,
              0);
    const WebpFile webp = read_webp(folder_ / "r.webp");
    ASSERT_EQ(webp.frames.size(), 1U);
    EXPECT_TRUE(webp.frames[0].rgba == png.rgba);
  }
}

TEST_F(RenderCommand, TurntableWritesAnimationOrFrames) {
  const auto json = mesher_json({"render", "bunny", "-o", "t.webp", "--size", "60", "--turntable",
                                 "--frames", "8", "--seconds", "2", "--validation"});
  EXPECT_EQ(json["turntable"]["frames"], 8);
  EXPECT_EQ(json["turntable"]["seconds"], 2.0);
  const WebpFile animation = read_webp(folder_ / "t.webp");
  ASSERT_EQ(animation.frames.size(), 8U);
  EXPECT_EQ(animation.ends_ms.back(), 2000U);
  ASSERT_EQ(mesher({"render", "bunny", "-o", "t_##.png", "--size", "60", "--turntable", "--frames",
                    "8", "--lod", "0.5"})
                .exit_code,
            0);
  EXPECT_EQ(folder_.count_files(), 9U);
  EXPECT_EQ(io::read_png(folder_ / "t_07.png").width, 60U);
}

TEST_F(RenderCommand, TurntableHas72FramesIn6Seconds) {
  ASSERT_EQ(mesher({"render", "cube", "-o", "t.webp", "--size", "16", "--turntable"}).exit_code, 0);
  const WebpFile animation = read_webp(folder_ / "t.webp");
  EXPECT_EQ(animation.frames.size(), 72U);
  ASSERT_FALSE(animation.ends_ms.empty());
  EXPECT_EQ(animation.ends_ms.back(), 6000U);
}

TEST_F(RenderCommand, InvalidPictureIsRejected) {
  const std::vector<std::vector<std::string>> cases{
      {"-o", "x.jpg"},
      {"-o", "x.png", "--scale", "0"},
      {"-o", "x.png", "--scale", "9"},
      {"-o", "x.png", "--scale", "1.5"},
      {"-o", "x.png", "--supersample", "4"},
      {"-o", "x.png", "--size", "16384", "--scale", "3"},
      {"-o", "x.png", "--size", "3840", "--scale", "8", "--supersample", "3"},
      {"-o", "x.webp", "--size", "3000", "--scale", "8"},
      {"-o", "x.png", "--turntable"},
      {"-o", "x_##.webp", "--turntable"},
      {"-o", "x.webp", "--frames", "9"},
      {"-o", "x.webp", "--seconds", "9"},
      {"-o", "x.webp", "--turntable", "--frames", "1"},
      {"-o", "x.webp", "--turntable", "--frames", "721"},
      {"-o", "x.webp", "--turntable", "--seconds", "nan"},
      {"-o", "x.webp", "--turntable", "--frames", "100", "--seconds", "1"}};
  for (std::vector<std::string> arguments : cases) {
    arguments.insert(arguments.begin(), {"render", "cube"});
    const Finished run = mesher(arguments);
    EXPECT_EQ(run.exit_code, 1) << run.err;
    EXPECT_FALSE(run.err.empty());
  }
  EXPECT_EQ(mesher({"render", "cube", "-o", "no/x_#.png", "--turntable"}).exit_code, 4);
  EXPECT_EQ(folder_.count_files(), 0U);
}

/// A glTF of a square whose animation "Rise" scales it by 3 along y within a second. The second one
/// has no name.
std::string rising_square() {
  GltfDocument document;
  document.floats(kSquareCorners, "VEC3", 3);
  document.indices(kSquareIndices);
  document.floats({0, 1}, "SCALAR", 1);
  document.floats({1, 1, 1, 1, 3, 1}, "VEC3", 3);
  return document.text(
      R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
      "animations":[{"name":"Rise","channels":[{"sampler":0,"target":{"node":0,"path":"scale"}}],
      "samplers":[{"input":2,"output":3}]},{"channels":[],"samplers":[]}])");
}

/// A glTF of a square whose normals, two sets of texture coordinates and tangents are the same at
/// all corners, with a material that uses map.png. `texture`: the member of the material.
std::string mapped_square(const std::string& texture, float handedness) {
  GltfDocument document;
  document.floats(kSquareCorners, "VEC3", 3);
  document.indices(kSquareIndices);
  const auto four_times = [](const std::vector<float>& value) {
    std::vector<float> all;
    for (int i = 0; i < 4; ++i)
      all.insert(all.end(), value.begin(), value.end());
    return all;
  };
  document.floats(four_times({0, 0, 1}), "VEC3", 3);
  document.floats(four_times({0.25F, 0.5F}), "VEC2", 2);
  document.floats(four_times({0.75F, 0.5F}), "VEC2", 2);
  document.floats(four_times({1, 0, 0, handedness}), "VEC4", 4);
  return document.text(
      R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":2,
      "TEXCOORD_0":3,"TEXCOORD_1":4,"TANGENT":5},"indices":1,"material":0}]}],
      "images":[{"uri":"map.png"}],"samplers":[{"magFilter":9728,"minFilter":9728}],
      "textures":[{"source":0,"sampler":0}],"materials":[{)" +
      texture + "}]");
}

TEST_F(RenderCommand, AllTextureCoordinatesAndTangentsCount) {
  const auto draw = [&](const std::string& texture, float handedness) {
    folder_.write("m.gltf", mapped_square(texture, handedness));
    return picture({"m.gltf", "--look", "material", "--view", "front"});
  };
  const auto middle = [](const Image& image) {
    const std::size_t at = 4 * (image.height / 2 * std::size_t{image.width} + image.width / 2);
    return std::array{int(image.rgba[at]), int(image.rgba[at + 1])};
  };
  // Red on the left, green on the right.
  io::write_png(folder_ / "map.png", {2, 1, {255, 0, 0, 255, 0, 255, 0, 255}});
  const auto base = [](const std::string& set) {
    return R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":)" + set + "}}";
  };
  const auto [red, no_green] = middle(draw(base("0"), 1));
  const auto [no_red, green] = middle(draw(base("1"), 1));
  EXPECT_GT(red, no_green + 50);
  EXPECT_GT(green, no_red + 50);
  // A normal map that leans down turns around with the bitangent.
  io::write_png(folder_ / "map.png", {1, 1, {128, 60, 220, 255}});
  const std::string normal = R"("normalTexture":{"index":0})";
  EXPECT_GT(difference(draw(normal, 1), draw(normal, -1)), 5.0);
}

TEST_F(RenderCommand, AnimationPosesTheModel) {
  folder_.write("m.gltf", rising_square());
  const auto height = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", "m.gltf", "-o", "r.png", "--size", "20"});
    // The camera looks at the center of the model, whose base is at 0.
    return 2.0 * mesher_json(arguments)["camera"]["pivot"][1].get<double>();
  };
  EXPECT_EQ(height({}), 1.0);
  EXPECT_EQ(height({"--animation", "Rise"}), 1.0);
  EXPECT_EQ(height({"--animation", "Rise", "--time", "0.5"}), 2.0);
  EXPECT_EQ(height({"--animation", "0", "--time", "99"}), 3.0);
  EXPECT_EQ(height({"--animation", "1", "--time", "1"}), 1.0);
  EXPECT_EQ(height({"--animation", "Rise", "--time", "1", "--lod", "1"}), 3.0);
  EXPECT_EQ(height({"--animation", "Rise", "--time", "1", "--faces", "2"}), 3.0);
  EXPECT_GT(difference(picture({"m.gltf", "--animation", "Rise", "--time", "1"}),
                       picture({"m.gltf", "--animation", "Rise"})),
            1.0);
  EXPECT_EQ(mesher({"render", "m.gltf", "-o", "t.webp", "--size", "16", "--turntable", "--frames",
                    "4", "--seconds", "1", "--animation", "Rise", "--time", "1"})
                .exit_code,
            0);
}

TEST_F(RenderCommand, InvalidAnimationIsRejected) {
  folder_.write("m.gltf", rising_square());
  const auto refusal = [&](std::vector<std::string> arguments, int exit_code) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"-o", "x.png"});
    const Finished run = mesher(arguments);
    EXPECT_EQ(run.exit_code, exit_code);
    return run.err;
  };
  EXPECT_EQ(refusal({"m.gltf", "--animation", "Jump"}, 2),
            "mesher: m.gltf: has no animation \"Jump\"; its animations are 0 \"Rise\", 1 \"\"\n");
  EXPECT_EQ(refusal({"m.gltf", "--animation"}, 2),
            "mesher: m.gltf: its animations are 0 \"Rise\", 1 \"\"\n");
  EXPECT_EQ(refusal({"bunny", "--animation", "Rise"}, 1),
            "mesher: --animation: bunny.obj has no animations\n");
  EXPECT_TRUE(holds(refusal({"missing.glb", "--animation", "Rise"}, 2), "missing.glb"));
  ASSERT_EQ(mesher({"progressive", "cube", "-o", "c.pm"}).exit_code, 0);
  for (const char* lod : {"0", "1"}) {
    EXPECT_EQ(refusal({"c.pm", "--animation", "Rise", "--lod", lod}, 1),
              "mesher: --animation: c.pm has no animations\n");
  }
  EXPECT_TRUE(holds(refusal({"m.gltf", "--time", "1"}, 1), "--animation"));
  for (const char* time : {"-1", "nan", "inf", "x"})
    EXPECT_TRUE(holds(refusal({"m.gltf", "--animation", "Rise", "--time", time}, 1), "--time"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.png"));
}

TEST_F(RenderCommand, InterruptLeavesNoFile) {
  for (const char* name : {"t.webp", "t_###.png"}) {
    const Finished run =
        shell(std::string("timeout -s INT 1.5 " MESHER_PROGRAM " render bunny -o ") + name +
              " --size 1200 --turntable --frames 360");
    EXPECT_NE(run.exit_code, 0);
    EXPECT_EQ(folder_.count_files(), 0U) << name;
  }
}

}  // namespace
}  // namespace mesher::test
