// Simplification to very few faces: no part shrinks away, flat parts get few faces, and the printed
// error is correct.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "engine/analysis/distance.h"
#include "engine/io/read.h"
#include "engine/simplify/simplify.h"
#include "tests/support/meshes.h"

namespace mesher::test {
namespace {

struct Quality {
  double rms_percent = 0.0;
  double max_percent = 0.0;
  double printed_percent = 0.0;
  std::uint32_t faces = 0;
};

Quality simplified_to(const Mesh& mesh, std::uint32_t faces, std::uint64_t samples = 50'000) {
  const simplify::Simplified result = simplify::simplify(Mesh(mesh), {.target_faces = faces});
  const analysis::SurfaceDistance d =
      analysis::surface_distance(mesh, result.mesh, {.samples = samples});
  const double square = d.forward.rms * d.forward.rms + d.backward.rms * d.backward.rms;
  return {d.percent(std::sqrt(0.5 * square)), d.percent(d.two_sided().max),
          d.percent(result.report.estimated_error), result.mesh.face_count()};
}

Mesh shared(const char* name) {
  const auto file = std::filesystem::path(MESHER_SHARED_MODELS) / name;
  return std::filesystem::exists(file) ? io::read_model(file, {}).mesh : Mesh();
}

/// RMS and maximum in percent of the diagonal. docs/simplification.md has the values of other
/// tools.
struct Expected {
  const char* model;
  std::uint32_t faces;
  double most_rms;
  double most_max;
};

class Coarse : public testing::TestWithParam<Expected> {};

TEST_P(Coarse, StaysCloseToTheModel) {
  const Expected& expected = GetParam();
  const Mesh mesh = shared(expected.model);
  if (mesh.face_count() == 0) GTEST_SKIP() << "SKIPPED: no shared model " << expected.model;
  const Quality quality = simplified_to(mesh, expected.faces);
  EXPECT_LE(quality.faces, expected.faces);
  EXPECT_LE(quality.rms_percent, expected.most_rms);
  EXPECT_LE(quality.max_percent, expected.most_max);
  EXPECT_NEAR(quality.printed_percent / quality.rms_percent, 1.0, 0.2);
}

INSTANTIATE_TEST_SUITE_P(
    Shared, Coarse,
    testing::Values(Expected{"beast.obj", 64, 1.3, 7.2}, Expected{"horse.obj", 96, 0.75, 4.27},
                    Expected{"cessna.obj", 200, 0.12, 1.98}, Expected{"bunny.obj", 64, 1.6, 10.0},
                    Expected{"armadillo.obj", 64, 1.6, 10.0}),
    [](const auto& expected) {
      const std::string name = expected.param.model;
      return name.substr(0, name.find('.')) + std::to_string(expected.param.faces);
    });

/// A sheet of 2 n n faces with a small dome in its center.
Mesh plate_with_dome(std::uint32_t n) {
  Soup soup = grid(n);
  const float middle = 0.5F * static_cast<float>(n);
  for (glm::vec3& p : soup.positions) {
    const float away = std::hypot(p.x - middle, p.y - middle) / (0.15F * static_cast<float>(n));
    if (away < 1.0F)
      p.z = 0.05F * static_cast<float>(n) * (1.0F - away * away) * (1.0F - away * away);
  }
  return built(std::move(soup)).mesh;
}

std::uint32_t flat_faces(const Mesh& mesh) {
  std::uint32_t count = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    bool is_flat = true;
    for (std::uint32_t c = 0; c < 3; ++c)
      is_flat &= mesh.position(mesh.origin(Mesh::halfedge(Face(f), c))).z == 0.0F;
    count += is_flat ? 1 : 0;
  }
  return count;
}

TEST(Flat, MostFacesGoToTheDome) {
  const Mesh plate = plate_with_dome(100);
  const simplify::Simplified result = simplify::simplify(Mesh(plate), {.target_faces = 1000});
  EXPECT_LT(flat_faces(result.mesh), 150U) << "of 1,000 faces";
  const analysis::SurfaceDistance d =
      analysis::surface_distance(plate, result.mesh, {.samples = 50'000});
  EXPECT_LT(d.percent(d.two_sided().rms), 0.001);
}

TEST(Flat, CornersOfAPlateDoNotMove) {
  const Mesh plate = built(grid(20)).mesh;
  const simplify::Simplified result = simplify::simplify(Mesh(plate), {.target_faces = 2});
  ASSERT_EQ(result.mesh.face_count(), 2U);
  for (std::uint32_t v = 0; v < result.mesh.vertex_count(); ++v) {
    const glm::vec3 p = result.mesh.position(Vertex(v));
    EXPECT_TRUE((p.x == 0.0F || p.x == 20.0F) && (p.y == 0.0F || p.y == 20.0F) && p.z == 0.0F)
        << p.x << ' ' << p.y << ' ' << p.z;
  }
}

TEST(Flat, DoesNotRemoveACornerForOneFace) {
  // An odd number of boundary collapses would have to remove a corner of the plate.
  const Mesh plate = plate_with_dome(40);
  const simplify::Simplified result = simplify::simplify(Mesh(plate), {.target_faces = 801});
  const analysis::SurfaceDistance d =
      analysis::surface_distance(plate, result.mesh, {.samples = 20'000});
  EXPECT_LT(d.percent(d.two_sided().max), 1.0);
  EXPECT_NEAR(result.mesh.face_count(), 801.0, 1.0);
}

TEST(PrintedError, IsWithin20PercentOfTheMeasuredError) {
  for (const auto& [name, mesh] :
       {std::pair{"torus", built(torus(120, 60)).mesh}, {"plate", plate_with_dome(80)}}) {
    for (const double ratio : {0.3, 0.1, 0.03, 0.01}) {
      const auto target = static_cast<std::uint32_t>(ratio * mesh.face_count());
      const Quality quality = simplified_to(mesh, target);
      if (quality.rms_percent < 1e-5) continue;
      EXPECT_NEAR(quality.printed_percent / quality.rms_percent, 1.0, 0.2)
          << name << " to " << target << " faces: " << quality.rms_percent;
    }
  }
}

class PrintedErrorOfModel : public testing::TestWithParam<const char*> {};

TEST_P(PrintedErrorOfModel, IsWithin20PercentOfTheMeasuredError) {
  const Mesh mesh = shared((std::string(GetParam()) + ".obj").c_str());
  if (mesh.face_count() == 0) GTEST_SKIP() << "SKIPPED: no shared model " << GetParam();
  const auto part = [&](double ratio) {
    return static_cast<std::uint32_t>(ratio * mesh.face_count());
  };
  for (const std::uint32_t target :
       {part(0.5), part(0.25), part(0.1), part(0.03), part(0.01), 512U, 256U, 128U}) {
    if (target >= mesh.face_count() || target < 100) continue;
    const Quality quality = simplified_to(mesh, target, 20'000);
    if (quality.rms_percent < 1e-5) continue;
    EXPECT_NEAR(quality.printed_percent / quality.rms_percent, 1.0, 0.2)
        << "to " << target << " faces: " << quality.rms_percent;
  }
}

INSTANTIATE_TEST_SUITE_P(Shared, PrintedErrorOfModel,
                         testing::Values("armadillo", "beast", "bunny", "cactus", "cessna",
                                         "fandisk", "horse", "rocker-arm", "spot", "suzanne",
                                         "teapot"),
                         [](const auto& model) {
                           std::string name = model.param;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace mesher::test
