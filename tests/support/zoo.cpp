#include "tests/support/zoo.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace mesher::test {

std::string sound_gltf();  // zoo_gltf.cpp
std::string sound_glb();
std::string posed_gltf();

namespace {

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kLittle = "binary_little_endian";
const std::string kIndices = "property list uchar int vertex_indices\n";

template <class T>
std::string number_bytes(const std::vector<T>& values, bool swapped = false) {
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
  bytes += number_bytes(kCorners, big);
  for (const std::vector<std::int32_t>& face : {std::vector<std::int32_t>{0, 1, 2}, {0, 3, 1}}) {
    bytes += '\3' + number_bytes(face, big);
  }
  return bytes;
}

std::string binary_stl(const std::vector<float>& corners, std::uint32_t claimed) {
  std::string bytes = std::string(80, ' ') + number_bytes<std::uint32_t>({claimed});
  for (std::size_t i = 0; i + 9 <= corners.size(); i += 9) {
    bytes +=
        std::string(12, '\0') +
        number_bytes(std::vector<float>(corners.begin() + static_cast<std::ptrdiff_t>(i),
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
              ply_header(kLittle, "4", "4000000000") + number_bytes(kCorners));
  pen.refused("PLY that claims four billion vertices",
              ply_header("ascii", "4000000000", "0") + kTextCorners);
  pen.refused("binary PLY that claims four billion vertices",
              ply_header(kLittle, "4000000000", "0") + number_bytes(kCorners));
  pen.refused("PLY count past 64 bits", ply_header("ascii", "99999999999999999999999", "0"));
  pen.refused("PLY count below zero", ply_header("ascii", "-1", "0"));
  pen.refused("PLY with one vertex too few", ply_header("ascii", "5", "0") + kTextCorners);
  pen.refused("PLY with one vertex too many", ply_header("ascii", "3", "1") + kTextCorners);
}

void add_ply_lists(const Enclosure& pen) {
  pen.refused("PLY list longer than the file",
              ply_header(kLittle, "4", "1") + number_bytes(kCorners) + "\xFF");
  pen.refused("PLY list of two billion",
              ply_header(kLittle, "4", "1", "property list int int vertex_indices\n") +
                  number_bytes(kCorners) + number_bytes<std::int32_t>({2147483647, 0, 1, 2}));
  pen.refused("PLY list below zero",
              ply_header(kLittle, "4", "1", "property list char int vertex_indices\n") +
                  number_bytes(kCorners) + "\x80" + number_bytes<std::int32_t>({0, 1, 2}));
  pen.refused("PLY list counted in fractions",
              ply_header("ascii", "4", "1", "property list float int vertex_indices\n") +
                  kTextCorners + "3 0 1 2\n");
  pen.refused("PLY index below zero", ply_header("ascii", "4", "1") + kTextCorners + "3 0 1 -1\n");
  pen.refused("PLY index past the end", ply_header("ascii", "4", "1") + kTextCorners + "3 0 1 4\n");
  pen.refused("PLY index past 64 bits",
              ply_header("ascii", "4", "1") + kTextCorners + "3 0 1 99999999999999999999\n");
  pen.refused("PLY indices that are fractions",
              ply_header(kLittle, "4", "1", "property list uchar float vertex_indices\n") +
                  number_bytes(kCorners) + '\3' + number_bytes<float>({0, 1, 2}));
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
               number_bytes<float>({kNaN, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) + '\3' +
               number_bytes<std::int32_t>({0, 1, 2}),
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
  for (const auto& [name, claimed] :
       {std::pair{"that claims four billion facets, with the size of two", 0xFFFFFFFFU},
        {"that claims one facet more", 3U},
        {"that claims none", 0U}}) {
    zoo.push_back({std::string("STL ") + name,
                   ".stl",
                   binary_stl(kFacets, claimed),
                   Fate::read,
                   2,
                   {{Repair::facet_counts_corrected, 1}}});
  }
  stl("that claims four billion facets", binary_stl(kFacets, 0xFFFFFFFFU) + "x");
  stl("with a normal of a hundred thousand words", "solid\nfacet normal " +
                                                       std::string(200000, ' ').replace(1, 1, "x") +
                                                       "1 x 1 x 1 x 1 x 1 x 1 x 1 "
                                                       "x 1 x 1 x 1 x 1\n");
  stl("of nothing but zero bytes", std::string(100000, '\0'));
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
  off("in UTF-16", std::string("\xFF\xFEO\0F\0F\0\n\0", 10));
  off("with a letter twice", "CCOFF\n4 1 0\n" + kTextCorners);
  zoo.push_back({"OFF with a thousand numbers after a vertex", ".off",
                 "OFF\n4 1 0\n0 0 0" + std::string(2000, ' ') + std::string(1000, '7') +
                     " nan 1e999 -1\n" + kTextCorners.substr(6) + "3 0 1 2 nan nan nan\n",
                 Fate::read, 1});
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
      sound("OBJ far from zero", ".obj",
            "s 1\nv 6000000.125 2000000.3333 0.1\nv 6000001.7 2000000.1 0.25 \\ \n\nv 6000000.3 "
            "2000001.4 0.5\nv 6000000.2 2000000.9 1.125\nf 1/9 2/-7 3\nf 1 3 4\np 1\n"),
      sound("PLY text", ".ply",
            ply_header("ascii", "4", "2") + kTextCorners + "3 0 1 2\n3 0 3 1\n"),
      sound("PLY little-endian", ".ply", binary_ply(false)),
      sound("PLY big-endian", ".ply", binary_ply(true)),
      sound(
          "PLY with all that is not kept", ".ply",
          "\xEF\xBB\xBFply\nformat ascii 1.0\nmade by hand\ncomment TextureFile a.png\nelement "
          "vertex "
          "4\nproperty double x\nproperty double y\nproperty double z\nproperty list uchar int "
          "q\nelement face 2\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty "
          "int texnumber\nelement edge 1\nproperty int a\nend_header\n7000000.1 0.25 0 "
          "0\n7000001.3 0 "
          "0 1 5\n7000000 1.0001 0 0\n7000000 0 1 2 1 2\n3 0 1 2 255 0\n3 0 3 1 9 1\n7\n"),
      sound("STL text", ".stl", text_stl()),
      sound("STL text with bad normals", ".stl",
            std::string(text_stl()).replace(text_stl().find("0 0 1"), 5, "-1.#IND nan 1")),
      sound("STL binary with colors", ".stl",
            binary_stl(kFacets, 0)
                .replace(0, 10, std::string("COLOR=\1\2\3\4", 10))
                .replace(132, 2, "ab")),
      sound("STL binary", ".stl", binary_stl(kFacets, 2)),
      sound("OFF", ".off", "OFF\n# c\n4 2 0\n" + kTextCorners + "3 0 1 2\n3 0 3 1 255 0 0\n"),
      sound("OFF with attributes", ".off",
            "NSTCOFF\n4 2 0\n0 0 0 0 0 1 1 0 0.5 0 1\n1 0 0 0 0 1 255 0 9 8 1 1\n0 1 0 0 0 1 1 1 1 "
            "0 0\n0 0 "
            "1 0 0 1 9 9 9 0 1\n3 0 1 2 7\n3 0 3 1 0.5 0.5 1.0\n"),
      sound("glTF", ".gltf", sound_gltf()),
      sound("glTF with a pose", ".gltf", posed_gltf()),
      sound("GLB", ".glb", sound_glb()),
  };
}

}  // namespace mesher::test
