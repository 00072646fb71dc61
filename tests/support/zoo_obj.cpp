#include <cmath>
#include <random>

#include "tests/support/zoo.h"
#include "tests/support/zoo_text.h"

namespace mesher::test {
namespace {

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string vertex(double x, double y, double z) {
  return "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
}

std::string face(int a, int b, int c) {
  return "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
}

std::string garbage(std::size_t size) {
  std::mt19937 random(42);
  std::string bytes(size, '\0');
  for (char& byte : bytes)
    byte = static_cast<char>(random());
  return bytes;
}

/// A polygon of `corners` corners on a circle, as one face.
std::string disc(int corners) {
  std::string text;
  std::string polygon = "f";
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * M_PI * i / corners;
    char line[64];
    std::snprintf(line, sizeof line, "v %.9g %.9g 0\n", std::cos(angle), std::sin(angle));
    text += line;
    polygon += " " + std::to_string(i + 1);
  }
  return text + polygon + "\n";
}

/// A polygon whose outline crosses itself everywhere.
std::string tangle(int corners) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::string text;
  std::string polygon = "f";
  for (int i = 0; i < corners; ++i) {
    text += vertex(unit(random), unit(random), unit(random));
    polygon += " " + std::to_string(i + 1);
  }
  return text + polygon + "\n";
}

std::string moebius(int segments) {
  std::string text;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * M_PI * i / segments;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(angle / 2);
      text += vertex(r * std::cos(angle), r * std::sin(angle), side * std::sin(angle / 2));
    }
  }
  for (int i = 0; i < segments; ++i) {
    const bool is_last = i + 1 == segments;
    const int a = 2 * i + 1;
    const int c = is_last ? 2 : a + 2;
    const int d = is_last ? 1 : a + 3;
    text += face(a, c, a + 1) + face(a + 1, c, d);
  }
  return text;
}

/// Adds shapes that are read, with the repairs that they need.
class ObjShapes {
 public:
  explicit ObjShapes(std::vector<Specimen>& zoo) : zoo_(zoo) {}

  void add_bad_faces();
  void add_repeated_faces();
  void add_cuts_and_creases();
  void add_polygons();
  void add_crowds();

 private:
  using R = Repair;

  void add(std::string name, std::string text, std::optional<std::uint32_t> faces,
           std::vector<std::pair<Repair, std::uint64_t>> repairs) {
    zoo_.push_back(
        {std::move(name), ".obj", std::move(text), Fate::read, faces, std::move(repairs)});
  }

  std::vector<Specimen>& zoo_;
};

void ObjShapes::add_bad_faces() {
  add("not a number", kTriangle + "v nan 0 0\nf 1 2 3\nf 1 2 4\n", 1,
      {{R::non_finite_vertices_dropped, 1}, {R::non_finite_faces_dropped, 1}});
  add("infinities", "v inf 0 0\nv 0 -inf 0\nv 0 0 1e999\nf 1 2 3\n", 0,
      {{R::non_finite_vertices_dropped, 3}, {R::non_finite_faces_dropped, 1}});
  add("largest and smallest numbers",
      "v 3.4e38 -3.4e38 1e-45\nv -3.4e38 3.4e38 0\nv 0 0 3.4e38\nf 1 2 3\n", 1, {});
  add("faces of no, one and two corners", kTriangle + "f\nf 1\nf 1 2\nf 1 2 3\n", 1,
      {{R::degenerate_faces_dropped, 3}});
  add("a vertex twice", kTriangle + "f 1 1 1\nf 1 2 2\nf 1 2 3\n", 1,
      {{R::degenerate_faces_dropped, 2}});
}

void ObjShapes::add_repeated_faces() {
  add("duplicate faces", kTriangle + "f 1 2 3\nf 2 3 1\nf 1 2 3\nf 3 2 1\n", 2,
      {{R::duplicate_faces_dropped, 2}, {R::second_sides_kept, 1}});
  add("both sides of a face a hundred thousand times",
      kTriangle + repeated("f 1 2 3\nf 3 2 1\n", kMany), 2,
      {{R::duplicate_faces_dropped, 2 * kMany - 2}, {R::second_sides_kept, 1}});
  std::string groups = kTriangle + "v 1 1 0\n";
  for (int i = 0; i < kMany; ++i)
    groups += "g " + std::to_string(i) + "\nf 1 2 3\nf 1 2 4 3\n";
  add("the same faces in a hundred thousand groups", groups, 16 + 32,
      {{R::second_sides_kept, 30}, {R::duplicate_faces_dropped, 2 * (kMany - 16)}});
  add("the same face a hundred thousand times", kTriangle + repeated("f 1 2 3\n", kMany), 1,
      {{R::duplicate_faces_dropped, kMany - 1}});
}

void ObjShapes::add_cuts_and_creases() {
  add("three faces at an edge", kTriangle + "v 0 0 1\nv 0 -1 0\nf 1 2 3\nf 2 1 4\nf 2 1 5\n", 3,
      {{R::non_manifold_edges_cut, 1}});
  add("two fans at a vertex", kTriangle + "v -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 4 5\n", 2,
      {{R::non_manifold_vertices_cut, 1}});
  add("a face with reversed orientation",
      kTriangle + "v 1 1 0\nv 2 1 0\nf 1 2 3\nf 2 4 3\nf 2 4 5\n", 3, {{R::faces_flipped, 1}});
  add("Moebius strip", moebius(20), 40, {});
  add("isolated vertices", kTriangle + "v 9 9 9\nv 8 8 8\nf 1 2 3\n", 1,
      {{R::isolated_vertices_dropped, 2}});
  add("creases on missing edges and of invalid sharpness",
      kTriangle + "v 1 1 0\nf 1 2 3\nf 2 4 3\ne 0 3 1\ne 1 2 nan\ne 0 1 -1\n", 2,
      {{R::creases_on_missing_edges, 1}, {R::invalid_sharpness_ignored, 2}});
}

void ObjShapes::add_polygons() {
  add("polygon of a million corners", disc(1000000), 999998, {{R::polygons_triangulated, 1}});
  add("polygon that crosses itself everywhere", tangle(3000), std::nullopt, {});
  add("polygon of one position",
      repeated("v 1 1 1\n", 1000) + disc(3) +
          [] {
            std::string polygon = "f";
            for (int i = 1; i <= 1000; ++i)
              polygon += " " + std::to_string(i);
            return polygon + "\n";
          }(),
      std::nullopt, {});
  add("polygon that goes back and forth", kTriangle + "f " + repeated("1 2 3 ", 2000) + "\n",
      std::nullopt, {});
}

void ObjShapes::add_crowds() {
  std::string fan = "v 0 0 0\n";
  std::string book = "v 0 0 0\nv 0 0 1\n";
  std::string brush = "v 0 0 0\n";
  std::string fan_faces;
  std::string book_faces;
  std::string brush_faces;
  for (int i = 0; i < kMany; ++i) {
    const double angle = 2 * M_PI * i / kMany;
    fan += vertex(1000 * std::cos(angle), 1000 * std::sin(angle), 0);
    fan_faces += face(1, i + 2, (i + 1) % kMany + 2);
    book += vertex(1000 * std::cos(angle), 1000 * std::sin(angle), 0);
    book_faces += face(1, 2, i + 3);
    brush +=
        vertex(std::cos(angle), std::sin(angle), 1) + vertex(std::cos(angle), std::sin(angle), 2);
    brush_faces += face(1, 2 * i + 2, 2 * i + 3);
  }
  add("a vertex of a hundred thousand edges", fan + fan_faces, kMany, {});
  add("an edge of a hundred thousand faces", book + book_faces, kMany,
      {{R::non_manifold_edges_cut, 1}});
  add("a vertex of a hundred thousand fans", brush + brush_faces, kMany,
      {{R::non_manifold_vertices_cut, 1}});
}

}  // namespace

void add_obj_text(std::vector<Specimen>& zoo) {
  const auto read = [&](std::string name, std::string text, std::optional<std::uint32_t> faces) {
    zoo.push_back({std::move(name), ".obj", std::move(text), Fate::read, faces});
  };
  const auto refused = [&](std::string name, std::string text) {
    zoo.push_back({std::move(name), ".obj", std::move(text)});
  };
  refused("empty", "");
  refused("only comments", "# a\n# b\n");
  refused("only faces", "f 1 2 3\n");
  read("only vertices", kTriangle, 0);
  refused("binary garbage", garbage(100000));
  refused("zero bytes", std::string(100000, '\0'));
  refused("a zero byte in a number", kTriangle + std::string("f 1 2\0 3\n", 9));
  refused("carriage returns alone", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r");
  std::string wide = "\xFF\xFE";
  for (const char c : kTriangle + "f 1 2 3\n")
    wide += {c, '\0'};
  refused("UTF-16", wide);
  read("byte order mark", "\xEF\xBB\xBF" + kTriangle + "f 1 2 3\n", 1);
  read("no line end at the end", kTriangle + "f 1 2 3", 1);
  refused("cut in a corner", kTriangle + "f 1 2 3/x");
  refused("cut in a vertex", kTriangle + "v 1 2");
  refused("a word for a number", kTriangle + "v one 2 3\n");
  refused("hexadecimal", kTriangle + "v 0x1p3 2 3\n");
  refused("comma for a point", kTriangle + "v 0,5 2 3\n");
  refused("index zero", kTriangle + "f 0 1 2\n");
  refused("index minus zero", kTriangle + "f -0 1 2\n");
  refused("index past the end", kTriangle + "f 1 2 4\n");
  refused("index past 32 bits", kTriangle + "f 1 2 4294967297\n");
  refused("index past 64 bits", kTriangle + "f 1 2 99999999999999999999999\n");
  refused("relative index before the start (CVE-2020-28589)", kTriangle + "f -1 -2 -4\n");
  refused("relative index past 32 bits", kTriangle + "f -1 -2 -4294967297\n");
  read("relative texture index before the start", kTriangle + "vt 0 0\nf 1/-2 2/-1 3/-1\n", 1);
  read("texture index without texture coordinates", kTriangle + "f 1/1 2/1 3/1\n", 1);
  read("normal index past the end", kTriangle + "vn 0 0 1\nf 1//1 2//2 3//1\n", 1);
  refused("crease of a missing vertex", kTriangle + "f 1 2 3\ne 0 3000000\n");
  refused("crease tag that claims billions",
          kTriangle + "t crease 4294967295/4294967295/0 0 1 1\n");
  refused("corner tag of a missing vertex", kTriangle + "t corner 1/1/0 3 1\n");
  read("number of a million digits",
       kTriangle + "v 0." + std::string(1000000, '7') + " 1 1\nf 1 2 4\n", 1);
  read("name of five megabytes (CVE-2023-35953)",
       kTriangle + "g " + std::string(5000000, 'g') + "\nf 1 2 3\ng other\nf 3 2 1\n",
       std::nullopt);
  read("comment of five megabytes",
       "#" + std::string(5000000, ' ') + "\n" + kTriangle + "f 1 2 3\n", 1);
  refused("line of five megabytes", kTriangle + "v " + repeated("12345 ", 900000) + "x\n");
  read("vertex with a million numbers",
       kTriangle + "v 1 1 1 " + repeated("1 ", 1000000) + "\nf 1 2 4\n", 1);
  read("a million line ends that do not end the line",
       kTriangle + "f 1 2 " + repeated("\\\n", 1000000) + "3\n", 1);
  read("a million one-index lines", kTriangle + repeated("l 1\n", 1000000) + "f 1 2 3\n", 1);
  read("lines and points out of range", kTriangle + "l 7 8\np 99\nl\np\nf 1 2 3\n", 1);
  std::string names = kTriangle;
  for (int i = 0; i < kMany; ++i)
    names += "usemtl m" + std::to_string(i) + "\nf 1 2 3\n";
  read("a hundred thousand materials", names, 16);  // as many sides as one place may have
  std::string joined = kTriangle + "o " + std::string(1000000, 'o') + "\n";
  for (int i = 0; i < kMany; ++i)
    joined += "g " + std::to_string(i) + "\n";
  read("groups in an object with a long name", joined + "f 1 2 3\n", 1);
  read("statements of other kinds",
       kTriangle + "cstype bspline\nsurf 0 1\nparm u 0\nend\nbevel on\ncall x\nf 1 2 3\n", 1);
}

void add_obj_shapes(std::vector<Specimen>& zoo) {
  ObjShapes shapes(zoo);
  shapes.add_bad_faces();
  shapes.add_repeated_faces();
  shapes.add_cuts_and_creases();
  shapes.add_polygons();
  shapes.add_crowds();
}

}  // namespace mesher::test
