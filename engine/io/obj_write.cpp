#include "engine/io/obj_write.h"

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/progress.h"
#include "engine/io/block_writer.h"
#include "engine/io/mtl_write.h"
#include "engine/io/vertex_attributes.h"
#include "engine/io/weld.h"
#include "engine/mesh/corner_attributes.h"

namespace mesher::io {
namespace {

constexpr std::size_t kNumber = 16;     ///< a float and the blank before it
constexpr std::size_t kFarNumber = 26;  ///< a FarCoordinate and the blank before it
constexpr std::size_t kIndex = 11;      ///< an index and its separator

/// Times of a vertex's position, a corner's texture coordinates and normal, and a face and its
/// creases, relative to the first, measured with 1.4 million faces.
constexpr double kPositionTime = 1.0;
constexpr double kTexcoordTime = 1.0;
constexpr double kNormalTime = 1.2;
constexpr double kFaceTime = 0.45;
constexpr double kCreaseTime = 0.02;

/// Distinct values of a corner attribute; corners without one have kNone.
template <class T>
struct Values {
  Weld weld;
  Array<std::uint32_t>
      number;  ///< for each distinct value, its index in the file from 1; kNone: NaN

  bool empty() const { return weld.index.empty(); }
  std::uint32_t of(std::size_t corner) const { return number[weld.index[corner]]; }
};

template <class T>
bool is_present(const T& value) {
  for (int i = 0; i < T::length(); ++i) {
    if (std::isnan(value[i])) return false;
  }
  return true;
}

/// Writes each distinct value once.
template <class T>
Values<T> write_values(AtomicFile& file, std::string_view keyword, const Array<T>& attribute,
                       Progress* progress) {
  Values<T> values;
  if (attribute.empty()) return values;
  Stages stages(progress, {1.0, 1.0});
  stages.next();
  values.weld = weld(reinterpret_cast<const std::uint32_t*>(attribute.data()),
                     static_cast<std::size_t>(T::length()), attribute.size(), progress);
  stages.next();
  Array<std::uint32_t> present;
  for (const std::uint32_t corner : values.weld.first) {
    const bool is_value = is_present(attribute[corner]);
    if (is_value) present.push_back(corner);
    values.number.push_back(is_value ? static_cast<std::uint32_t>(present.size()) : kNone);
  }
  write_elements(file, present.size(), keyword.size() + T::length() * kNumber + 1, progress,
                 [&](Appender& out, std::size_t i) {
                   out << keyword;
                   for (int k = 0; k < T::length(); ++k)
                     out << ' ' << attribute[present[i]][k];
                   out << '\n';
                 });
  return values;
}

void write_positions(AtomicFile& file, const Mesh& mesh, const CornerAttributes& attributes,
                     const glm::dvec3& origin, Progress* progress) {
  const bool is_far = origin != glm::dvec3(0.0);
  const Array<glm::u8vec4> colors =
      gather_to_vertices(mesh.origins(), mesh.vertex_count(), attributes.color, glm::u8vec4(255));
  write_elements(file, mesh.vertex_count(), 2 + 3 * kFarNumber + 4 * kNumber, progress,
                 [&](Appender& out, std::size_t v) {
                   const glm::vec3& p = mesh.positions()[v];
                   out << 'v';
                   for (int k = 0; k < 3; ++k) {
                     out << ' ';
                     is_far ? out << FarCoordinate{origin[k], p[k]} : out << p[k];
                   }
                   if (!colors.empty()) {
                     for (int k = 0; k < (colors[v].a == 255 ? 3 : 4); ++k) {
                       out << ' ' << static_cast<float>(colors[v][k]) / 255.0F;
                     }
                   }
                   out << '\n';
                 });
}

/// Replaces control characters. Names also come from other formats, where they may hold anything.
std::string one_line(std::string name) {
  for (char& c : name) {
    if (static_cast<unsigned char>(c) < ' ') c = '_';
  }
  return name;
}

/// Writes the statements by which the faces of a group differ from those before.
void write_group(Appender& out, const FaceGroup& before, const FaceGroup& group,
                 const std::vector<std::string>& materials) {
  const auto write = [&](std::string_view keyword, const std::string& old, std::string_view usual,
                         const std::string& text) {
    if (text == old) return;
    const std::string line =
        std::string(keyword) + one_line(text.empty() ? std::string(usual) : text);
    out.need(line.size() + 1);
    out << line << '\n';
  };
  const auto name_of = [&](std::uint32_t material) {
    return material < materials.size() ? materials[material] : std::string();
  };
  write("o ", before.object, "", group.object);
  write("g ", before.name, "", group.name);
  write("usemtl ", name_of(before.material), "", name_of(group.material));
  write("s ", before.smoothing, "off", group.smoothing);
}

void write_faces(AtomicFile& file, const Mesh& mesh, const CornerAttributes& attributes,
                 const Values<glm::vec2>& texcoords, const Values<glm::vec3>& normals,
                 const std::vector<std::string>& materials, Progress* progress) {
  const auto& group = attributes.group;
  write_elements(file, mesh.face_count(), 4 + 9 * kIndex, progress,
                 [&](Appender& out, std::size_t f) {
                   if (!group.empty() && (f == 0 || group[f] != group[f - 1])) {
                     write_group(out, f == 0 ? FaceGroup() : attributes.groups[group[f - 1]],
                                 attributes.groups[group[f]], materials);
                     out.need(4 + 9 * kIndex);
                   }
                   out << 'f';
                   for (std::size_t h = 3 * f; h < 3 * f + 3; ++h) {
                     out << ' ' << mesh.origins()[h].index() + 1;
                     const std::uint32_t texcoord = texcoords.empty() ? kNone : texcoords.of(h);
                     const std::uint32_t normal = normals.empty() ? kNone : normals.of(h);
                     if (texcoord != kNone || normal != kNone) out << '/';
                     if (texcoord != kNone) out << texcoord;
                     if (normal != kNone) out << '/' << normal;
                   }
                   out << '\n';
                 });
}

std::string sharpness_text(float sharpness) {
  char text[16];
  return {text, std::to_chars(text, text + sizeof text, sharpness).ptr};
}

void write_creases(AtomicFile& file, const Mesh& mesh, const Progress* progress) {
  constexpr std::uint32_t kHalfedgesBetweenChecks = 1U << 18;
  std::string text;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    if (i % kHalfedgesBetweenChecks == 0) check_cancelled(progress);
    const Halfedge h(i);
    if (!(mesh.sharpness(h) > 0.0F) || mesh.halfedge(mesh.edge(h)) != h) continue;
    if (text.empty()) text = "# Creases: e lines count vertices from 0, unlike f lines.\n";
    text += "e " + std::to_string(mesh.origin(h).index()) + " " +
            std::to_string(mesh.target(h).index()) + " " + sharpness_text(mesh.sharpness(h)) + "\n";
  }
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const float sharpness = mesh.sharpness(Vertex(v));
    if (!(sharpness > 0.0F)) continue;
    text += "t corner 1/1/0 " + std::to_string(v) + " " + sharpness_text(sharpness) + "\n";
  }
  file.write(text);
}

}  // namespace

void write_obj(AtomicFile& file, const Mesh& mesh, const Attributes& wedges,
               const WriteOptions& options) {
  Progress* const progress = options.progress;
  const CornerAttributes attributes = to_corners(mesh, wedges);
  Stages stages(progress, {kPositionTime * mesh.vertex_count(),
                           kTexcoordTime * double(attributes.texcoord.size()),
                           kNormalTime * double(attributes.normal.size()),
                           kFaceTime * mesh.face_count(), kCreaseTime * mesh.face_count()});
  stages.next();
  file.write("# mesher: " + std::to_string(mesh.vertex_count()) + " vertices, " +
             std::to_string(mesh.face_count()) + " faces\n");
  const MtlReference materials =
      options.materials ? add_mtl(file, *options.materials) : MtlReference();
  for (const std::string& library : materials.libraries)
    file.write("mtllib " + one_line(library) + "\n");
  write_positions(file, mesh, attributes, options.origin, progress);
  stages.next();
  const Values<glm::vec2> texcoords = write_values(file, "vt", attributes.texcoord, progress);
  stages.next();
  const Values<glm::vec3> normals = write_values(file, "vn", attributes.normal, progress);
  stages.next();
  write_faces(file, mesh, attributes, texcoords, normals, materials.names, progress);
  stages.next();
  write_creases(file, mesh, progress);
}

}  // namespace mesher::io
