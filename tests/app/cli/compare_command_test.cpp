// Tests `compare`: measures of the look, pictures, and poses.
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "app/cli/compare_pictures.h"
#include "engine/io/png.h"
#include "tests/app/program_test.h"
#include "tests/support/gltf_document.h"

namespace mesher::test {
namespace {

using app::LookDifference;
using app::ViewAngles;

glm::dvec3 direction_of(const ViewAngles& angles) {
  const double yaw = glm::radians(angles.yaw_deg);
  const double pitch = glm::radians(angles.pitch_deg);
  return {std::cos(pitch) * std::sin(yaw), std::sin(pitch), std::cos(pitch) * std::cos(yaw)};
}

TEST(ViewAnglesOfPictures, AreSpreadEvenly) {
  for (const std::uint32_t views : {1U, 6U, 24U, 100U}) {
    const std::vector<ViewAngles> all = app::view_angles(views);
    ASSERT_EQ(all.size(), views);
    glm::dvec3 sum(0.0);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < all.size(); ++i) {
      sum += direction_of(all[i]);
      for (std::size_t k = 0; k < i; ++k)
        nearest = std::min(nearest, glm::length(direction_of(all[i]) - direction_of(all[k])));
    }
    if (views == 1) continue;
    EXPECT_LT(glm::length(sum) / views, 0.15);
    EXPECT_GT(nearest, 2.0 / std::sqrt(double(views)));
  }
}

TEST(LookDifference, StatisticsLeaveOutEmptyViews) {
  LookDifference look;
  for (const double error : {0.0, 4.0, 16.0})
    look.views.push_back({.difference = {.pixels = 10, .squared_error = error, .ssim = 0.5}});
  look.views.push_back({.difference = {.pixels = 0}});
  EXPECT_DOUBLE_EQ(look.psnr_db().median, analysis::psnr_db(4.0));
  EXPECT_DOUBLE_EQ(look.psnr_db().min, analysis::psnr_db(16.0));
  EXPECT_DOUBLE_EQ(look.psnr_db().mean, analysis::psnr_db(20.0 / 3.0));
  EXPECT_DOUBLE_EQ(look.ssim().median, 0.5);
  look.views.resize(1);
  look.views.push_back(look.views[0]);
  EXPECT_TRUE(std::isinf(look.psnr_db().median));
  EXPECT_TRUE(std::isinf(look.psnr_db().mean));
}

class CompareCommand : public ProgramTest {
 protected:
  /// A square in the plane z = 0 whose texture is shifted along u.
  static std::string square(double shift, const std::string& head = "") {
    const auto vt = [&](double u, double v) {
      return "vt " + std::to_string(u + shift) + " " + std::to_string(v) + "\n";
    };
    return head + "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n" + vt(0, 0) + vt(1, 0) + vt(1, 1) +
           vt(0, 1) + (head.empty() ? "" : "usemtl m\n") + "f 1/1 2/2 3/3 4/4\n";
  }

  std::size_t pictures_in(const std::string& folder) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / folder))
      count += entry.path().extension() == ".png" ? 1 : 0;
    return count;
  }
};

TEST_F(CompareCommand, SlideIsInTexelsOfUnknownTexture) {
  folder_.write("a.obj", square(0.0));
  folder_.write("b.obj", square(8.0 / 1024.0));
  const auto json = mesher_json({"compare", "a.obj", "b.obj", "--samples", "2000"});
  for (const char* percentile : {"p50", "p90", "p99", "max"})
    EXPECT_NEAR(json["uv_slide_texels"]["two_sided"][percentile].get<double>(), 8.0, 0.01);
  EXPECT_NEAR(json["texture_deviation"]["two_sided"]["rms"].get<double>(), 8.0 / 1024.0, 1e-5);
  EXPECT_NEAR(json["texture_deviation"]["forward"]["max_percent"].get<double>(),
              100.0 * 8.0 / 1024.0 / std::sqrt(2.0), 1e-3);
  EXPECT_NEAR(json["uv_stretch"]["l2"].get<double>(), 1.0, 1e-4);
  EXPECT_EQ(json["flipped_uvs"]["faces"], 0);
  for (const char* part : {"first", "second", "new"})
    EXPECT_EQ(json["uv_overlap_percent"][part], 0.0);
  EXPECT_EQ(json["normal_deviation_deg"]["two_sided"]["max"], 0.0);
  EXPECT_EQ(json["normal_deviation_deg"]["first_normals"], "faces");
  EXPECT_FALSE(json.contains("color_difference"));
  EXPECT_EQ(json["not_measured"]["vertex colors"], "the models have no vertex colors");
  const Finished words = mesher({"compare", "a.obj", "b.obj", "--samples", "2000"});
  EXPECT_TRUE(holds(words.out, "\nUV slide [texels]     50 % ")) << words.out;
  EXPECT_TRUE(holds(words.out, "not measured          the models have no vertex colors\n"));
}

TEST_F(CompareCommand, SlideIsInTexelsOfBaseColorTexture) {
  Image image{.width = 64, .height = 16, .rgba = {}};
  image.rgba.assign(std::size_t{4} * 64 * 16, 200);
  io::write_png(folder_ / "t.png", image);
  folder_.write("m.mtl", "newmtl m\nmap_Kd t.png\n");
  folder_.write("a.obj", square(0.0, "mtllib m.mtl\n"));
  folder_.write("b.obj", square(0.25));
  const auto json = mesher_json({"compare", "a.obj", "b.obj", "--samples", "2000"});
  EXPECT_NEAR(json["uv_slide_texels"]["two_sided"]["p90"].get<double>(), 16.0, 1e-3);
}

TEST_F(CompareCommand, EqualModelsHaveEqualPictures) {
  const auto json = mesher_json({"compare", "cube", "cube", "--samples", "500", "--pictures", "p/q",
                                 "--views", "3", "--picture-size", "64x48"});
  const auto& clay = json["pictures"]["clay"];
  EXPECT_TRUE(clay["psnr_db"]["median"].is_null());
  EXPECT_TRUE(clay["psnr_db"]["mean"].is_null());
  EXPECT_EQ(clay["ssim"]["min"], 1.0);
  EXPECT_EQ(clay["views"].size(), 3U);
  EXPECT_GT(clay["views"][0]["pixels"], 100);
  EXPECT_FALSE(json["pictures"].contains("textured")) << "it has no colors";
  EXPECT_EQ(pictures_in("p/q"), 3U);
  const Image image = io::read_png(folder_ / "p/q/clay_02.png");
  EXPECT_EQ(image.width, 3U * 64U);
  EXPECT_EQ(image.height, 48U);
  const Finished words = mesher({"compare", "cube", "cube", "--samples", "500", "--pictures", "p",
                                 "--views", "2", "--picture-size", "32"});
  EXPECT_TRUE(holds(words.out, "clay PSNR [dB]        median equal, min equal, mean equal; SSIM"))
      << words.out;
}

TEST_F(CompareCommand, ColorsAreComparedInPictures) {
  const auto ply = [](const char* color) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    for (const char* position : {"0 0 0", "1 0 0", "1 1 0", "0 1 0"})
      text += std::string(position) + " " + color + "\n";
    return text + "3 0 1 2\n3 0 2 3\n";
  };
  folder_.write("a.ply", ply("200 100 50"));
  folder_.write("b.ply", ply("210 110 60"));
  const auto json = mesher_json({"compare", "a.ply", "b.ply", "--samples", "500", "--pictures", "p",
                                 "--views", "4", "--picture-size", "64"});
  // All channels differ by 10.
  EXPECT_NEAR(json["pictures"]["textured"]["psnr_db"]["median"].get<double>(),
              20.0 * std::log10(25.5), 0.5);
  EXPECT_TRUE(json["pictures"]["clay"]["psnr_db"]["median"].is_null());
  EXPECT_GT(json["color_difference"]["cie76"]["two_sided"]["mean"], 2.0);
  EXPECT_LT(json["color_difference"]["ciede2000"]["two_sided"]["mean"], 6.0);
  EXPECT_EQ(pictures_in("p"), 8U);
}

TEST_F(CompareCommand, OutputIsTheSameForAnyNumberOfThreads) {
  std::vector<std::string> outputs;
  std::vector<Image> images;
  for (const char* threads : {"1", "2", "5"}) {
    const Finished run =
        mesher({"compare", "knot", "bunny_1k", "--json", "--samples", "3000", "--pictures", "p",
                "--views", "2", "--picture-size", "64", "--threads", threads});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    outputs.push_back(run.out);
    images.push_back(io::read_png(folder_ / "p/clay_01.png"));
  }
  EXPECT_EQ(outputs[0], outputs[1]);
  EXPECT_EQ(outputs[0], outputs[2]);
  EXPECT_EQ(images[0].rgba, images[1].rgba);
}

TEST_F(CompareCommand, AnimationPosesBothModels) {
  // Two squares that grow along y by 3 and by 5 within a second.
  const auto growing = [](float factor) {
    GltfDocument document;
    document.floats(kSquareCorners, "VEC3", 3);
    document.indices(kSquareIndices);
    document.floats({0, 1}, "SCALAR", 1);
    document.floats({1, 1, 1, 1, factor, 1}, "VEC3", 3);
    return document.text(
        R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
        "animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"scale"}}],
        "samplers":[{"input":2,"output":3}]}])");
  };
  folder_.write("a.gltf", growing(3.0F));
  folder_.write("b.gltf", growing(5.0F));
  const auto farthest = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"compare", "a.gltf", "b.gltf", "--samples", "500"});
    return mesher_json(arguments)["certified_max"]["lower"].get<double>();
  };
  EXPECT_EQ(farthest({}), 0.0);
  EXPECT_EQ(farthest({"--animation", "0"}), 0.0);
  EXPECT_NEAR(farthest({"--animation", "0", "--time", "0.5"}), 1.0, 1e-6);
  EXPECT_NEAR(farthest({"--animation", "0", "--time", "1"}), 2.0, 1e-6);
  const Finished refused = mesher({"compare", "a.gltf", "cube", "--animation", "0"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_TRUE(holds(refused.err, "has no animations")) << refused.err;
}

TEST_F(CompareCommand, PicturesAreRefusedWithReason) {
  EXPECT_EQ(mesher({"compare", "cube", "cube", "--views", "3"}).exit_code, 1);
  EXPECT_EQ(mesher({"compare", "cube", "cube", "--pictures", "p", "--views", "0"}).exit_code, 1);
  EXPECT_EQ(
      mesher({"compare", "cube", "cube", "--pictures", "p", "--picture-size", "big"}).exit_code, 1);
  folder_.write("file", "");
  const Finished taken = mesher({"compare", "cube", "cube", "--pictures", "file/p"});
  EXPECT_EQ(taken.exit_code, 4) << taken.err;
  const Finished none =
      mesher({"compare", "cube", "cube", "--pictures", "p", "--samples", "100"},
             {"VK_ICD_FILENAMES=/nonexistent.json", "VK_DRIVER_FILES=/nonexistent.json"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_TRUE(holds(none.err, "Vulkan")) << none.err;
  EXPECT_EQ(none.out, "");
  EXPECT_EQ(pictures_in("p"), 0U);
}

TEST_F(CompareCommand, BadTextureCoordinatesAreNoFailure) {
  folder_.write("a.obj", square(0.0));
  folder_.write("b.obj", square(std::numeric_limits<double>::quiet_NaN()));
  const Finished run = mesher({"compare", "a.obj", "b.obj", "--samples", "500"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

}  // namespace
}  // namespace mesher::test
