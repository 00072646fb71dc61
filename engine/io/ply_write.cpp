#include <bit>
#include <cstdlib>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/io/block_writer.h"
#include "engine/io/image_placer.h"
#include "engine/io/ply_textures.h"
#include "engine/io/polygon_write.h"
#include "engine/io/vertex_attributes.h"
#include "engine/mesh/corner_attributes.h"

namespace mesher::io {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is written as it lies here");

/// Time of a face, relative to a vertex.
constexpr double kPlyFaceTime = 1.0;

/// Appends values in the file's encoding: text separated by blanks, or bytes as in memory.
class PlyValues {
 public:
  PlyValues(Appender& out, bool ascii) : out_(out), ascii_(ascii) {}

  template <class T>
  void value(T value) {
    if (!ascii_) {
      out_.raw(value);
      return;
    }
    if (!is_first_) out_ << ' ';
    is_first_ = false;
    if constexpr (std::is_same_v<T, std::int32_t>) {
      if (value < 0) out_ << '-';
      out_ << static_cast<std::uint32_t>(std::abs(value));
    } else if constexpr (sizeof(T) == 1) {
      out_ << static_cast<std::uint32_t>(value);
    } else {
      out_ << value;
    }
  }
  template <class Vector>
  void vector(const Vector& v) {
    for (int i = 0; i < Vector::length(); ++i)
      value(v[i]);
  }
  void position(const glm::dvec3& origin, const glm::vec3& local) {
    for (int i = 0; i < 3; ++i) {
      const FarCoordinate coordinate{origin[i], local[i]};
      if (!ascii_) {
        out_.raw(coordinate.value());
        continue;
      }
      if (!is_first_) out_ << ' ';
      is_first_ = false;
      out_ << coordinate;
    }
  }
  void end_row() {
    if (ascii_) out_ << '\n';
  }

 private:
  Appender& out_;
  bool ascii_;
  bool is_first_ = true;
};

struct VertexValues {
  Array<glm::vec3> normal;
  Array<glm::vec2> texcoord;
  Array<glm::u8vec4> color;
};

/// The textures of a file.
struct FileTextures {
  std::vector<std::string> files;
  Array<std::int32_t> of_face;  ///< -1: none; empty if all faces have the only one
};

FileTextures textures_of(AtomicFile& file, const Attributes& attributes,
                         const Materials* materials) {
  FileTextures textures;
  if (materials == nullptr) return textures;
  const PlyTextures held = ply_textures(*materials);
  ImagePlacer placer(file, *materials);
  for (const std::uint32_t image : held.images)
    textures.files.push_back(placer.place(image, "texture"));
  if (held.images.empty()) return textures;
  const auto number_of = [&](std::uint32_t group) {
    const std::uint32_t material = attributes.groups[group].material;
    const std::uint32_t number =
        material < held.of_material.size() ? held.of_material[material] : kNone;
    return number == kNone ? -1 : static_cast<std::int32_t>(number);
  };
  bool are_all_first = held.images.size() == 1;
  for (const std::uint32_t group : attributes.group) {
    textures.of_face.push_back(number_of(group));
    are_all_first = are_all_first && textures.of_face.back() == 0;
  }
  if (are_all_first) textures.of_face.clear();
  return textures;
}

/// Returns a comment without line ends.
std::string comment_of(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = '_';
  }
  return "comment " + text + "\n";
}

std::string header(const Mesh& mesh, const VertexValues& values, const FileTextures& textures,
                   bool has_seams, bool is_far, bool ascii) {
  std::string text = ascii ? "ply\nformat ascii 1.0\n" : "ply\nformat binary_little_endian 1.0\n";
  text += "comment written by mesher\n";
  for (const std::string& name : textures.files)
    text += comment_of("TextureFile " + name);
  text += "element vertex " + std::to_string(mesh.vertex_count()) +
          (is_far ? "\nproperty double x\nproperty double y\nproperty double z\n"
                  : "\nproperty float x\nproperty float y\nproperty float z\n");
  if (!values.normal.empty()) text += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!values.texcoord.empty()) text += "property float s\nproperty float t\n";
  if (!values.color.empty()) {
    text += "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
  }
  text += "element face " + std::to_string(mesh.face_count()) +
          "\nproperty list uchar int vertex_indices\n";
  if (has_seams) text += "property list uchar float texcoord\n";
  if (!textures.of_face.empty()) text += "property int texnumber\n";
  return text + "end_header\n";
}

}  // namespace

void write_ply(AtomicFile& file, const Mesh& mesh, const Attributes& wedges,
               const WriteOptions& options) {
  const glm::dvec3 origin = options.origin;
  const bool ascii = options.ascii;
  Progress* const progress = options.progress;
  const CornerAttributes attributes = to_corners(mesh, wedges);
  const bool is_far = origin != glm::dvec3(0.0);
  Stages stages(progress, {double(mesh.vertex_count()), kPlyFaceTime * mesh.face_count()});
  stages.next();
  const auto at_vertices = [&](const auto& of_corners, const auto& unused) {
    return gather_to_vertices(mesh.origins(), mesh.vertex_count(), of_corners, unused);
  };
  const VertexValues values{.normal = at_vertices(attributes.normal, glm::vec3(0.0F)),
                            .texcoord = at_vertices(attributes.texcoord, glm::vec2(0.0F)),
                            .color = at_vertices(attributes.color, glm::u8vec4(255))};
  const bool has_seams = !attributes.texcoord.empty() && values.texcoord.empty();
  const FileTextures textures = textures_of(file, wedges, options.materials.get());
  file.write(header(mesh, values, textures, has_seams, is_far, ascii));
  constexpr std::size_t kMostVertexBytes = 3 * 26 + 5 * 16 + 4 * 11 + 1;
  write_elements(file, mesh.vertex_count(), kMostVertexBytes, progress,
                 [&](Appender& out, std::size_t v) {
                   PlyValues row(out, ascii);
                   const glm::vec3& p = mesh.positions()[v];
                   is_far ? row.position(origin, p) : row.vector(p);
                   if (!values.normal.empty()) row.vector(values.normal[v]);
                   if (!values.texcoord.empty()) row.vector(values.texcoord[v]);
                   if (!values.color.empty()) row.vector(values.color[v]);
                   row.end_row();
                 });
  stages.next();
  constexpr std::size_t kMostFaceBytes = 6 * 11 + 6 * 16 + 1;
  write_elements(file, mesh.face_count(), kMostFaceBytes, progress,
                 [&](Appender& out, std::size_t f) {
                   PlyValues row(out, ascii);
                   row.value(std::uint8_t{3});
                   for (std::size_t h = 3 * f; h < 3 * f + 3; ++h)
                     row.value(mesh.origins()[h].index());
                   if (has_seams) {
                     row.value(std::uint8_t{6});
                     for (std::size_t h = 3 * f; h < 3 * f + 3; ++h)
                       row.vector(attributes.texcoord[h]);
                   }
                   if (!textures.of_face.empty()) row.value(textures.of_face[f]);
                   row.end_row();
                 });
}

}  // namespace mesher::io
