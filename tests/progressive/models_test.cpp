// Every level of the progressive meshes of real models.
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <string>

#include "engine/analysis/distance.h"
#include "engine/io/read.h"
#include "engine/progressive/build.h"
#include "engine/simplify/simplify.h"
#include "tests/progressive/checks.h"
#include "tests/support/meshes.h"
#include "tests/support/obj_files.h"

namespace mesher::test {
namespace {

/// Root mean square of the distances in both directions.
double rms(const Mesh& a, const Mesh& b) {
  return analysis::surface_distance(a, b, {.samples = 50'000}).two_sided().rms;
}

/// Checks that a level is about as accurate as simplification to the same size. The levels are
/// slightly worse, because simplification with a distant target looks less closely at each edge
/// (measured: at most 1.12).
void expect_accurate(progressive::ProgressiveMesh& mesh, const Mesh& input) {
  for (const double ratio : {0.3, 0.05}) {
    const auto faces = static_cast<std::uint32_t>(ratio * input.face_count());
    mesh.go_to(mesh.level_for_faces(faces));
    const Mesh direct = simplify::simplify(Mesh(input), {.target_faces = faces}).mesh;
    EXPECT_LE(rms(input, mesh.mesh()), 1.15 * rms(input, direct)) << ratio;
  }
}

void examine(const std::filesystem::path& file, std::uint32_t base_faces) {
  SCOPED_TRACE(file.filename().string());
  const Mesh input = io::read_model(file, {}).mesh;
  if (input.face_count() == 0) return;
  progressive::Progressive progressive =
      progressive::make_progressive(input, {.target_faces = base_faces});
  progressive::ProgressiveMesh& mesh = progressive.mesh;
  examine_levels(mesh, 16);
  progressive::ProgressiveMesh again = appended(mesh);
  expect_same(mesh, again);
  mesh.go_to(mesh.split_count());
  ASSERT_EQ(mesh.mesh().vertex_count(), input.vertex_count());
  ASSERT_EQ(mesh.mesh().face_count(), input.face_count());
  for (std::uint32_t h = 0; h < input.halfedge_count(); ++h) {
    const Halfedge source = progressive.face_source[h / 3];
    const std::uint32_t corner = (Mesh::corner(source) + h) % 3;
    const Vertex v = mesh.mesh().origin(Halfedge(h));
    ASSERT_EQ(progressive.vertex_source[v.index()],
              input.origin(Mesh::halfedge(Mesh::face(source), corner)));
    ASSERT_EQ(mesh.mesh().position(v), input.position(progressive.vertex_source[v.index()]));
  }
  if (input.face_count() > 10'000) expect_accurate(mesh, input);
}

TEST(Models, AssetsAreExactAtFullDetail) {
  for (const std::filesystem::path& file : files_in(MESHER_SOURCE_DIR "/assets"))
    examine(file, 1);
}

class Scan : public testing::TestWithParam<const char*> {};

TEST_P(Scan, IsExactAtFullDetail) {
  const std::filesystem::path file =
      std::filesystem::path(MESHER_SHARED_MODELS) / (std::string(GetParam()) + ".obj");
  if (!std::filesystem::exists(file)) {
    std::cerr << "*** NOT TESTED: " << file << " is missing ***\n";
    return;
  }
  examine(file, 200);
}

INSTANTIATE_TEST_SUITE_P(Shared, Scan,
                         testing::Values("armadillo", "bunny", "cactus", "fandisk", "spot",
                                         "suzanne", "teapot"));

}  // namespace
}  // namespace mesher::test
