#include "engine/io/far_origin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "engine/io/losses.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "tests/support/bytes.h"
#include "tests/support/temp_folder.h"

namespace mesher::io {
namespace {

using test::TempFolder;

/// A fan of triangles around the first point, with coordinates as a survey writes them.
struct Survey {
  std::vector<glm::dvec3> points;
  double extent = 0.0;
};

Survey survey(const glm::dvec3& at, double extent, int decimals) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.0, extent);
  const double unit = std::pow(10.0, -decimals);
  Survey result;
  glm::dvec3 low(1e300);
  glm::dvec3 high(-1e300);
  for (int i = 0; i < 50; ++i) {
    glm::dvec3 p = at + glm::dvec3(part(random), part(random), part(random));
    for (int k = 0; k < 3; ++k)
      p[k] = std::round(p[k] / unit) * unit;
    result.points.push_back(p);
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  result.extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  return result;
}

std::string digits(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string row(const glm::dvec3& p) {
  return digits(p.x) + " " + digits(p.y) + " " + digits(p.z) + "\n";
}

std::string text_of(const Survey& data, const std::string& format) {
  const std::size_t n = data.points.size();
  std::string text;
  if (format == "off") text = "OFF\n" + std::to_string(n) + " " + std::to_string(n - 2) + " 0\n";
  const bool is_ply = format != "off" && format != "obj";
  const std::string encoding = format == "ply" ? "ascii" : "binary_little_endian";
  if (is_ply) {
    text = "ply\nformat " + encoding + " 1.0\nelement vertex " + std::to_string(n) +
           "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
           std::to_string(n - 2) + "\nproperty list uchar int vertex_indices\nend_header\n";
  }
  for (const glm::dvec3& p : data.points) {
    if (format == "binary.ply") {
      text += test::bytes_of<double>({p.x, p.y, p.z});
    } else {
      text += (format == "obj" ? "v " : "") + row(p);
    }
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const std::string last = std::to_string(i) + " " + std::to_string(i + 1) + "\n";
    if (format == "binary.ply") {
      text += '\3' + test::bytes_of<std::int32_t>({0, std::int32_t(i), std::int32_t(i + 1)});
    } else if (format == "obj") {
      text += "f 1 " + std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n";
    } else {
      text += "3 0 " + last;
    }
  }
  return text;
}

/// The largest distance of a coordinate of the model from the survey's.
double error_of(const Model& model, const Survey& data) {
  EXPECT_EQ(model.mesh.vertex_count(), data.points.size());
  double worst = 0.0;
  for (std::uint32_t v = 0; v < model.mesh.vertex_count(); ++v) {
    const glm::dvec3 p = model.origin + glm::dvec3(model.mesh.position(Vertex(v)));
    for (int k = 0; k < 3; ++k)
      worst = std::max(worst, std::abs(p[k] - data.points[v][k]));
  }
  return worst;
}

const double kBound = std::exp2(-24);

// Meters from the equator, earth-centered coordinates, and a part of a machine far off.
const std::vector<Survey>& surveys() {
  static const std::vector<Survey> kAll = {
      survey({6000000, 2000000, 120}, 500, 4), survey({-4130000.5, 2890000, 3900000}, 30, 3),
      survey({3, 0, 0}, 1, 12), survey({1e9, -1e9, 1e9}, 1e-3, 7), survey({0, 0, 7000}, 1, 6)};
  return kAll;
}

TEST(FarOrigin, EveryReaderOfDoublesKeepsTheDigits) {
  const TempFolder folder;
  for (const Survey& data : surveys()) {
    for (const char* format : {"obj", "off", "ply", "binary.ply"}) {
      SCOPED_TRACE(format);
      const Model model =
          read_model(folder.write(std::string("m.") + format, text_of(data, format)));
      EXPECT_LE(error_of(model, data), data.extent * kBound);
    }
  }
}

TEST(FarOrigin, EveryFormatThatCanKeepsTheDigits) {
  const TempFolder folder;
  for (const Survey& data : surveys()) {
    const Model model = read_model(folder.write("m.obj", text_of(data, "obj")));
    for (const char* name : {"o.obj", "o.off", "o.ply", "a.ply", "o.gltf", "o.glb"}) {
      SCOPED_TRACE(name);
      write_model(folder / name, model.mesh, model.attributes,
                  {.ascii = name[0] == 'a', .origin = model.origin});
      const Model again = read_model(folder / name);
      EXPECT_LE(error_of(again, data), 1.5 * data.extent * kBound);
      EXPECT_TRUE(
          losses_in_format(folder / name, model.mesh, model.attributes, nullptr, {}, model.origin)
              .empty());
    }
    for (const char* name : {"o.stl", "o.pm"}) {
      const auto lost =
          losses_in_format(folder / name, model.mesh, model.attributes, nullptr, {}, model.origin);
      ASSERT_EQ(lost.size(), model.origin == glm::dvec3(0.0) ? 0U : 1U);
      if (lost.empty()) continue;
      EXPECT_TRUE(lost[0].starts_with("digits of coordinates")) << lost[0];
    }
  }
}

TEST(FarOrigin, StlHasTheNearestFloats) {
  const TempFolder folder;
  const Survey& data = surveys()[0];
  const Model model = read_model(folder.write("m.obj", text_of(data, "obj")));
  write_model(folder / "o.stl", model.mesh, model.attributes, {.origin = model.origin});
  const Model again = read_model(folder / "o.stl");
  EXPECT_EQ(again.origin, glm::dvec3(0.0));
  EXPECT_EQ(again.mesh.position(Vertex(0)), glm::vec3(data.points[0]));
}

// A number comes out with the digits that it came in with.
TEST(FarOrigin, TextHasTheDigitsOfTheFile) {
  const TempFolder folder;
  const std::string vertices =
      "v 6000008.3333 2000000 121.1955\nv 6000016.6667 2000000.5 122.3642\nv 6000025 2000100.25 "
      "123.4797\n";
  const Model model = read_model(folder.write("m.obj", vertices + "f 1 2 3\n"));
  write_model(folder / "o.obj", model.mesh, model.attributes, {.origin = model.origin});
  EXPECT_NE(test::read_bytes(folder / "o.obj").find(vertices), std::string::npos);
}

// Nothing changes for ordinary files: their floats are as near to the numbers as others would be.
TEST(FarOrigin, OrdinaryFilesHaveNone) {
  const TempFolder folder;
  for (const Survey& data :
       {survey({0, 0, 0}, 1, 12), survey({-5, -5, -5}, 10, 15), survey({-1e-9, 0, 0}, 2e-9, 15),
        survey({10, 10, 10}, 500, 9), survey({-1e30, -1e30, -1e30}, 2e30, 0)}) {
    for (const char* format : {"obj", "off", "ply", "binary.ply"}) {
      SCOPED_TRACE(format);
      const Model model =
          read_model(folder.write(std::string("m.") + format, text_of(data, format)));
      EXPECT_EQ(model.origin, glm::dvec3(0.0));
      EXPECT_EQ(model.mesh.position(Vertex(3)), glm::vec3(data.points[3]));
    }
  }
}

TEST(FarOrigin, WholeNumbersNeedNone) {
  const TempFolder folder;
  const Model model = read_model(folder.write(
      "m.obj", "v 6000000 2000000 0\nv 6000001 2000000 0\nv 6000000 2000001 0\nf 1 2 3\n"));
  EXPECT_EQ(model.origin, glm::dvec3(0.0)) << "single precision holds them exactly";
}

TEST(FarOrigin, HostileNumbersAreRead) {
  const TempFolder folder;
  for (const char* vertices :
       {"v 1e308 0 0\nv 1e300 1 0\nv 0 1e-320 0\n", "v 0.1 0.1 0.1\nv 0.1 0.1 0.1\nv 0.1 0.1 0.1\n",
        "v nan 1e999 -1e999\nv 1 2 3.3\nv 1e38 1e-45 0.1\n",
        "v 3.3e38 3.3e38 3.3e38\nv 3.3e38 3.3e38 3.3e38\nv 3.3e38 3.3e38 3.29999e38\n",
        "v 1e-40 1e-41 1e-42\nv 1e-44 1e-45 1e-46\nv 0 0 1e-50\n"}) {
    const Soup soup = read_soup(folder.write("m.obj", std::string(vertices) + "f 1 2 3\n"));
    EXPECT_TRUE(std::isfinite(soup.origin.x + soup.origin.y + soup.origin.z)) << vertices;
  }
}

}  // namespace
}  // namespace mesher::io
