#include "tests/support/zoo.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace mesher::test {

std::string sound_gltf();  // zoo_gltf.cpp
std::string sound_glb();

namespace {

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kLittle = "binary_little_endian";
const std::string kIndices = "property list uchar int vertex_indices\n";

template <class T>
std::string bytes_of(const std::vector<T>& values, bool swapped = false) {
  std::string all;
  for (const T& value : values) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    if (swapped) std::reverse(bytes.begin(), bytes.end());
    all += bytes;
  }
  return all;
}

std::string ply_header(const std::string& format, const std::string& vertices,
                       const std::string& faces, const std::string& list = kIndices) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + vertices + "\n" + kXyz +
         "element face " + faces + "\n" + list + "end_header\n";
}

const std::string kTextCorners = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::vector<float> kCorners = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};

std::string binary_ply(bool big) {
  std::string bytes = ply_header(big ? "binary_big_endian" : "binary_little_endian", "4", "2");
  bytes += bytes_of(kCorners, big);
  for (const std::vector<std::int32_t>& face : {std::vector<std::int32_t>{0, 1, 2}, {0, 3, 1}}) {
    bytes += '\3' + bytes_of(face, big);
  }
  return bytes;
}

std::string binary_stl(const std::vector<float>& corners, std::uint32_t claimed) {
  std::string bytes = std::string(80, ' ') + bytes_of<std::uint32_t>({claimed});
  for (std::size_t i = 0; i + 9 <= corners.size(); i += 9) {
    bytes += std::string(12, '\0') +
             bytes_of(std::vector<float>(corners.begin() + static_cast<std::ptrdiff_t>(i),
                                         corners.begin() + static_cast<std::ptrdiff_t>(i + 9))) +
             std::string(2, '\0');
  }
  return bytes;
}

const std::vector<float> kFacets = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0};

std::string text_stl() {
  const std::string facet = "facet normal 0 0 1\n outer loop\n";
  return "solid s\n" + facet + "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n" +
         facet + "vertex 0 0 0\nvertex 0 0 1\nvertex 1 0 0\nendloop\nendfacet\nendsolid s\n";
}

}  // namespace

namespace {

void add_ply_counts(const Enclosure& pen) {
  pen.refused("PLY empty", "");
  pen.refused("PLY of its magic alone", "ply\n");
  pen.refused("PLY header without end", "ply\nformat ascii 1.0\nelement vertex 3\n" + kXyz);
  pen.refused("PLY header of zero bytes", "ply\n" + std::string(100000, '\0'));
  pen.refused("PLY that claims four billion faces (assimp #5729)",
              ply_header("ascii", "4", "4000000000") + kTextCorners);
  pen.refused("binary PLY that claims four billion faces",
              ply_header(kLittle, "4", "4000000000") + bytes_of(kCorners));
  pen.refused("PLY that claims four billion vertices",
              ply_header("ascii", "4000000000", "0") + kTextCorners);
  pen.refused("binary PLY that claims four billion vertices",
              ply_header(kLittle, "4000000000", "0") + bytes_of(kCorners));
  pen.refused("PLY count past 64 bits", ply_header("ascii", "99999999999999999999999", "0"));
  pen.refused("PLY count below zero", ply_header("ascii", "-1", "0"));
  pen.refused("PLY with one vertex too few", ply_header("ascii", "5", "0") + kTextCorners);
  pen.refused("PLY with one vertex too many", ply_header("ascii", "3", "1") + kTextCorners);
}

void add_ply_lists(const Enclosure& pen) {
  pen.refused("PLY list longer than the file",
              ply_header(kLittle, "4", "1") + bytes_of(kCorners) + "\xFF");
  pen.refused("PLY list of two billion",
              ply_header(kLittle, "4", "1", "property list int int vertex_indices\n") +
                  bytes_of(kCorners) + bytes_of<std::int32_t>({2147483647, 0, 1, 2}));
  pen.refused("PLY list below zero",
              ply_header(kLittle, "4", "1", "property list char int vertex_indices\n") +
                  bytes_of(kCorners) + "\x80" + bytes_of<std::int32_t>({0, 1, 2}));
  pen.refused("PLY list counted in fractions",
              ply_header("ascii", "4", "1", "property list float int vertex_indices\n") +
                  kTextCorners + "3 0 1 2\n");
  pen.refused("PLY index below zero", ply_header("ascii", "4", "1") + kTextCorners + "3 0 1 -1\n");
  pen.refused("PLY index past the end", ply_header("ascii", "4", "1") + kTextCorners + "3 0 1 4\n");
  pen.refused("PLY index past 64 bits",
              ply_header("ascii", "4", "1") + kTextCorners + "3 0 1 99999999999999999999\n");
  pen.refused("PLY indices that are fractions",
              ply_header(kLittle, "4", "1", "property list uchar float vertex_indices\n") +
                  bytes_of(kCorners) + '\3' + bytes_of<float>({0, 1, 2}));
}

void add_ply_properties(const Enclosure& pen) {
  pen.refused("PLY vertices without z",
              "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
              "y\nend_header\n0 0\n");
  pen.refused(
      "PLY coordinates that are lists",
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar float x\nproperty float "
      "y\nproperty float z\nend_header\n1 0 0 0\n");
  pen.refused("PLY vertices without properties",
              "ply\nformat ascii 1.0\nelement vertex 4000000000\nend_header\n");
  pen.refused("PLY element twice", "ply\nformat ascii 1.0\nelement vertex 1\n" + kXyz +
                                       "element vertex 2\n" + kXyz + "end_header\n0 0 0\n");
  std::string properties = "ply\nformat ascii 1.0\nelement vertex 1\n" + kXyz;
  for (int i = 0; i < 100000; ++i)
    properties += "property float p" + std::to_string(i) + "\n";
  pen.refused("PLY of a hundred thousand properties", properties + "end_header\n0 0 0\n");
  pen.refused("PLY with letters for numbers", ply_header("ascii", "1", "0") + "a b c\n");
  pen.refused("PLY of another format", "ply\nformat utf-8 1.0\nend_header\n");
}

void add_odd_ply(const Enclosure& pen) {
  pen.refused("PLY strip past the end",
              "ply\nformat ascii 1.0\nelement vertex 4\n" + kXyz +
                  "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
                  kTextCorners + "4 0 1 2 9\n");
  pen.read("PLY elements without properties, by the billion",
           "ply\nformat ascii 1.0\nelement a 18446744073709551615\nelement face "
           "18446744073709551615\nelement vertex 4\n" +
               kXyz + "end_header\n" + kTextCorners,
           0);
  std::string polygon = ply_header("ascii", "300", "1", "property list uint uint vertex_index\n");
  std::string corners = "300";
  for (int i = 0; i < 300; ++i) {
    polygon +=
        std::to_string(std::cos(i * 0.0209)) + " " + std::to_string(std::sin(i * 0.0209)) + " 0\n";
    corners += " " + std::to_string(i);
  }
  pen.read("PLY list wider than a byte (MeshLab #1216)", polygon + corners + "\n", 298);
  pen.read("PLY without faces", ply_header("ascii", "4", "0") + kTextCorners, 0);
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  pen.read("PLY with coordinates that are no numbers",
           ply_header(kLittle, "4", "1") +
               bytes_of<float>({kNaN, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) + '\3' +
               bytes_of<std::int32_t>({0, 1, 2}),
           0, {{Repair::non_finite_vertices_dropped, 1}, {Repair::non_finite_faces_dropped, 1}});
}

}  // namespace

void add_ply(std::vector<Specimen>& zoo) {
  const Enclosure pen(zoo, ".ply");
  add_ply_counts(pen);
  add_ply_lists(pen);
  add_ply_properties(pen);
  add_odd_ply(pen);
}

void add_stl_and_off(std::vector<Specimen>& zoo) {
  const auto stl = [&](std::string name, std::string bytes, Fate fate = Fate::refused) {
    zoo.push_back({"STL " + std::move(name), ".stl", std::move(bytes), fate});
  };
  stl("empty", "");
  stl("of its header alone", std::string(80, ' '));
  stl("that claims four billion facets", binary_stl(kFacets, 0xFFFFFFFFU));
  stl("that claims one facet more", binary_stl(kFacets, 3));
  stl("without facets", binary_stl({}, 0));
  stl("cut in a facet", binary_stl(kFacets, 2).substr(0, 150));
  stl("text without facets", "solid nothing\nendsolid nothing\n");
  stl("text cut short", text_stl().substr(0, 100));
  stl("text with four corners",
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid\n");
  stl("text with a word of five megabytes", "solid\n" + std::string(5000000, 'f'));
  stl("text with binary behind", text_stl() + std::string(1000, '\1'));
  std::string binary = binary_stl(kFacets, 2);
  binary.replace(0, 5, "solid");
  stl("binary that begins like text", binary, Fate::read);
  zoo.push_back({"STL of one position",
                 ".stl",
                 binary_stl(std::vector<float>(900, 1.0F), 100),
                 Fate::read,
                 0,
                 {{Repair::degenerate_faces_dropped, 100}}});

  const auto off = [&](std::string name, std::string bytes) {
    zoo.push_back({"OFF " + std::move(name), ".off", std::move(bytes)});
  };
  off("empty", "");
  off("of its magic alone", "OFF");
  off("that claims billions of vertices", "OFF\n4000000000 1 0\n" + kTextCorners);
  off("that claims billions of faces", "OFF\n4 4000000000 0\n" + kTextCorners);
  off("with counts below zero", "OFF\n-4 -1 0\n" + kTextCorners);
  off("with a count past 64 bits", "OFF\n99999999999999999999 1 0\n" + kTextCorners);
  off("with one vertex too few", "OFF\n5 1 0\n" + kTextCorners + "3 0 1 2\n");
  off("with an index past the end", "OFF\n4 1 0\n" + kTextCorners + "3 0 1 4\n");
  off("with an index below zero", "OFF\n4 1 0\n" + kTextCorners + "3 0 1 -1\n");
  off("with a face of billions", "OFF\n4 1 0\n" + kTextCorners + "4000000000 0 1 2\n");
  off("with letters", "OFF\n4 1 0\nzero 0 0\n");
  off("of four dimensions", "4OFF\n1 0 0\n0 0 0 1\n");
  off("in binary", "OFF BINARY\n\1\2\3\4");
  off("without the colors that it announces", "COFF\n4 0 0\n" + kTextCorners);
}

std::vector<Specimen> zoo() {
  std::vector<Specimen> all;
  add_obj_text(all);
  add_obj_shapes(all);
  add_ply(all);
  add_stl_and_off(all);
  add_gltf(all);
  return all;
}

std::vector<Specimen> sound_files() {
  const auto sound = [](std::string name, std::string extension, std::string bytes) {
    return Specimen{std::move(name), std::move(extension), std::move(bytes), Fate::read, 2};
  };
  return {
      sound("OBJ", ".obj",
            "# two triangles\nmtllib m\no one\nv 0 0 0 1 0 0\nv 1 0 0\nv 0 1 -0.5e1\nv 0 0 1\nvt 0 "
            "0.5\nvn 0 0 1\n"
            "g a\nusemtl b\nf 1/1/1 2/1/1 3/1/1\ng c\nf -4//1 -1//1 -3//-1\ne 0 1 2.5\nt crease "
            "2/1/0 0 2 1\n"
            "t corner 1/1/0 3 inf\nl 1 2 \\\n3\n"),
      sound("PLY text", ".ply",
            ply_header("ascii", "4", "2") + kTextCorners + "3 0 1 2\n3 0 3 1\n"),
      sound("PLY little-endian", ".ply", binary_ply(false)),
      sound("PLY big-endian", ".ply", binary_ply(true)),
      sound("STL text", ".stl", text_stl()),
      sound("STL binary", ".stl", binary_stl(kFacets, 2)),
      sound("OFF", ".off", "OFF\n# c\n4 2 0\n" + kTextCorners + "3 0 1 2\n3 0 3 1 255 0 0\n"),
      sound("glTF", ".gltf", sound_gltf()),
      sound("GLB", ".glb", sound_glb()),
  };
}

}  // namespace mesher::test
