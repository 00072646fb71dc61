#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "engine/mesh/validate.h"
#include "tests/support/attributes.h"
#include "tests/support/temp_folder.h"

namespace mesher {
namespace {

using test::read_bytes;
using test::TempFolder;

/// A sheet of n x n quads with coordinates of every magnitude.
std::string sheet(int n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> exponent(-30.0F, 30.0F);
  std::string text;
  char line[128];
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      std::snprintf(line, sizeof line, "v %d.5 %.9g %.9g\n", x + (n + 1) * y,
                    static_cast<double>(std::pow(10.0F, exponent(random))),
                    static_cast<double>(-std::pow(10.0F, exponent(random))));
      text += line;
    }
  }
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x + 1;
      std::snprintf(line, sizeof line, "f %d %d %d\nf %d %d %d\n", a, a + 1, a + n + 2, a,
                    a + n + 2, a + n + 1);
      text += line;
    }
  }
  return text;
}

Model read_text(const std::string& text) {
  const TempFolder folder;
  return io::read_model(folder.write("in.obj", text));
}

template <class T>
bool same_bits(const T& a, const T& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

struct RoundTrip {
  const char* file;
  bool ascii;
};

TEST(RoundTrip, EveryFormatKeepsExactPositionsAndFaces) {
  const Model model = read_text(sheet(40));
  ASSERT_TRUE(validate(model.mesh).empty());
  const TempFolder folder;
  for (const RoundTrip way : {RoundTrip{"m.obj", false},
                              {"m.ply", false},
                              {"m.ply", true},
                              {"m.off", false},
                              {"m.stl", false},
                              {"m.stl", true},
                              {"m.gltf", false},
                              {"m.glb", false},
                              {"M.OBJ", false}}) {
    io::write_model(folder / way.file, model.mesh, model.attributes, {.ascii = way.ascii});
    const Model back = io::read_model(folder / way.file);
    EXPECT_TRUE(validate(back.mesh).empty()) << way.file;
    EXPECT_TRUE(back.report.is_clean()) << way.file;
    ASSERT_EQ(back.mesh.face_count(), model.mesh.face_count()) << way.file;
    // STL numbers vertices in the order of the faces. Every format keeps the corners.
    for (std::uint32_t h = 0; h < model.mesh.halfedge_count(); ++h) {
      const glm::vec3& a = model.mesh.position(model.mesh.origin(Halfedge(h)));
      const glm::vec3& b = back.mesh.position(back.mesh.origin(Halfedge(h)));
      ASSERT_EQ(std::memcmp(&a, &b, sizeof a), 0) << way.file << " corner " << h;
    }
    if (std::string_view(way.file) != "m.stl") {
      EXPECT_TRUE(same_bits(back.mesh.positions(), model.mesh.positions())) << way.file;
    }
    EXPECT_EQ(folder.count_files(), 1U) << way.file;
    std::filesystem::remove(folder / way.file);
  }
}

TEST(RoundTrip, BowTieCopiesAreWrittenAsPlainVertices) {
  const Model model = read_text(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\nv 0 -1 0\nv 0 0 -1\n"
      "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 5 6\nf 1 7 5\nf 5 7 6\nf 6 7 1\n");
  ASSERT_EQ(model.mesh.bow_tie_copies().size(), 2U);
  MeshArrays arrays = MeshArrays::take(Mesh(model.mesh));
  arrays.bow_tie_copies.clear();
  const Mesh plain = std::move(arrays).finish();
  const TempFolder folder;
  for (const char* name : {"m.obj", "m.ply", "m.off", "m.stl", "m.glb"}) {
    io::write_model(folder / name, plain, {});
    const std::string expected = read_bytes(folder / name);
    io::write_model(folder / name, model.mesh, {});
    EXPECT_EQ(read_bytes(folder / name), expected) << name;
  }
  io::write_model(folder / "m.obj", model.mesh, {});
  const std::string obj = read_bytes(folder / "m.obj");
  EXPECT_EQ(obj.find("\nt corner"), std::string::npos);
  EXPECT_EQ(obj.find("\ne "), std::string::npos);
}

TEST(RoundTrip, SameBytesForAnyThreadCount) {
  const Model model = read_text(sheet(150));
  const TempFolder folder;
  for (const char* name : {"m.obj", "m.ply", "m.off", "m.stl", "m.glb"}) {
    io::write_model(folder / name, model.mesh, model.attributes);
    const std::string parallel = read_bytes(folder / name);
    const ThreadLimit one(1);
    io::write_model(folder / name, model.mesh, model.attributes);
    EXPECT_EQ(read_bytes(folder / name), parallel) << name;
  }
}

/// Two triangles with a seam along their edge, one color per vertex, two groups and three creases.
const std::string kRich =
    "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 0.2 0.4 0.6 0.8\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\nvn 0 0 1\nvn 0 1 0\n"
    "g left\nf 1/1/1 2/2/1 3/3/2\ng right\nf 1/5/1 3//1 4/4\n"
    "e 0 2 2.5\ne 0 1\nt corner 1/1/0 3 4\n";

TEST(RoundTrip, ObjKeepsAttributesGroupsAndCreases) {
  const Model model = read_text(kRich);
  ASSERT_EQ(test::corners_of(model).texcoord.size(), 6U);
  const TempFolder folder;
  io::write_model(folder / "m.obj", model.mesh, model.attributes);
  const Model back = io::read_model(folder / "m.obj");
  EXPECT_TRUE(same_bits(test::corners_of(back).texcoord, test::corners_of(model).texcoord));
  EXPECT_TRUE(same_bits(test::corners_of(back).normal, test::corners_of(model).normal));
  EXPECT_TRUE(same_bits(test::corners_of(back).color, test::corners_of(model).color));
  EXPECT_EQ(back.attributes.group, model.attributes.group);
  EXPECT_EQ(back.attributes.groups, model.attributes.groups);
  EXPECT_TRUE(same_bits(back.mesh.sharpnesses(), model.mesh.sharpnesses()));
  EXPECT_TRUE(same_bits(back.mesh.vertex_sharpnesses(), model.mesh.vertex_sharpnesses()));
  EXPECT_EQ(model.mesh.sharpness(model.mesh.find_halfedge(Vertex(0), Vertex(2))), 2.5F);
  EXPECT_NE(read_bytes(folder / "m.obj").find("# Creases: e lines count vertices from 0"),
            std::string::npos);
}

TEST(RoundTrip, ObjWritesEachValueOnce) {
  const Model model = read_text(kRich);
  const TempFolder folder;
  io::write_model(folder / "m.obj", model.mesh, model.attributes);
  const std::string text = read_bytes(folder / "m.obj");
  std::size_t lines = 0;
  for (std::size_t at = text.find("\nvt "); at != std::string::npos;
       at = text.find("\nvt ", at + 1)) {
    ++lines;
  }
  EXPECT_EQ(lines, 5U);
  EXPECT_NE(text.find("3//1"), std::string::npos);
}

TEST(RoundTrip, PlyKeepsSeamsAndVertexColors) {
  const Model model = read_text(kRich);
  const TempFolder folder;
  for (const bool ascii : {false, true}) {
    io::write_model(folder / "m.ply", model.mesh, model.attributes, {.ascii = ascii});
    const Model back = io::read_model(folder / "m.ply");
    EXPECT_TRUE(same_bits(test::corners_of(back).color, test::corners_of(model).color));
    for (std::size_t c = 0; c < 6; ++c) {
      const glm::vec2 a = test::corners_of(back).texcoord[c];
      const glm::vec2 b = test::corners_of(model).texcoord[c];
      EXPECT_TRUE(a == b || (std::isnan(a.x) && std::isnan(b.x))) << c;
    }
  }
}

TEST(RoundTrip, OffKeepsVertexColors) {
  const Model model = read_text(kRich);
  const TempFolder folder;
  io::write_model(folder / "m.off", model.mesh, model.attributes);
  EXPECT_TRUE(same_bits(test::corners_of(io::read_model(folder / "m.off")).color,
                        test::corners_of(model).color));
}

TEST(Write, FailedWriteLeavesNoFile) {
  const Model model = read_text(kRich);
  const TempFolder folder;
  EXPECT_THROW(io::write_model(folder / "m.xyz", model.mesh, model.attributes), UsageError);
  EXPECT_THROW(io::write_model(folder / "m", model.mesh, model.attributes), UsageError);
  EXPECT_THROW(io::write_model(folder / "no/m.obj", model.mesh, model.attributes), OutputError);
  EXPECT_EQ(folder.count_files(), 0U);
}

/// Limits the size of files during its lifetime, like a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_ = {};
};

TEST(Write, FullDiskLeavesNoPartialFile) {
  const Model model = read_text(sheet(40));
  const TempFolder folder;
  folder.write("m.ply", "what was there before");
  for (const char* name : {"m.obj", "m.ply", "m.stl", "m.off", "m.glb", "m.gltf"}) {
    const SmallDisk disk(10000);
    EXPECT_THROW(io::write_model(folder / name, model.mesh, model.attributes), OutputError) << name;
  }
  EXPECT_EQ(folder.count_files(), 1U);
  EXPECT_EQ(read_bytes(folder / "m.ply"), "what was there before");
}

TEST(Read, RejectsUnknownMissingAndEmptyFiles) {
  const TempFolder folder;
  EXPECT_THROW(io::read_soup(folder.write("m.xyz", "x")), InputError);
  EXPECT_THROW(io::read_soup(folder / "missing.obj"), InputError);
  for (const char* name : {"m.obj", "m.ply", "m.stl", "m.off", "m.gltf", "m.glb"}) {
    EXPECT_THROW(io::read_soup(folder.write(name, "")), InputError) << name;
  }
}

TEST(Read, BuildErrorsNameTheFile) {
  const TempFolder folder;
  const Model model =
      io::read_model(folder.write("name.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  EXPECT_EQ(model.name, "name.obj");
}

}  // namespace
}  // namespace mesher
