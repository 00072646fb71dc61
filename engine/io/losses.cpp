#include "engine/io/losses.h"

#include <algorithm>
#include <cmath>

#include "engine/io/format.h"
#include "engine/io/vertex_attributes.h"
#include "engine/mesh/corner_attributes.h"

namespace mesher::io {
namespace {

bool is_absent(const glm::vec2& v) {
  return std::isnan(v.x) || std::isnan(v.y);
}
bool is_absent(const glm::vec3& v) {
  return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z);
}
bool is_absent(const glm::u8vec4&) {
  return false;
}

template <class T>
void add_attribute(std::vector<std::string>& losses, const std::string& name, Holds holds,
                   const Mesh& mesh, const Array<T>& values) {
  if (values.empty() || holds == Holds::each_corner) return;
  if (holds == Holds::nothing) {
    losses.push_back(name);
  } else if (holds == Holds::one_per_vertex) {
    if (gather_to_vertices(mesh.origins(), mesh.vertex_count(), values, T()).empty()) {
      losses.push_back(name + " (they differ around vertices)");
    }
  } else if (std::any_of(values.begin(), values.end(), [](const T& v) { return is_absent(v); })) {
    losses.push_back(name + " (some corners have none)");
  }
}

std::size_t count_creases(const Mesh& mesh) {
  std::size_t count = 0;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const bool is_first = mesh.edge(Halfedge(h)).index() == h;
    count += is_first && mesh.sharpness(Halfedge(h)) > 0.0F ? 1 : 0;
  }
  return count;
}

}  // namespace

std::vector<std::string> losses_in_format(const std::filesystem::path& file, const Mesh& mesh,
                                          const Attributes& attributes) {
  std::vector<std::string> losses;
  const FormatInfo* format = format_of(file);
  if (format == nullptr) return losses;
  const FormatContents& can = format->holds;
  const std::size_t creases = can.creases ? 0 : count_creases(mesh);
  if (creases > 0) losses.push_back(std::to_string(creases) + " creases");
  if (!can.creases && !mesh.vertex_sharpnesses().empty()) {
    losses.emplace_back("sharpness of vertices");
  }
  const CornerAttributes corners = to_corners(mesh, attributes);
  add_attribute(losses, "texture coordinates", can.texcoord, mesh, corners.texcoord);
  add_attribute(losses, "normals", can.normal, mesh, corners.normal);
  add_attribute(losses, "colors", can.color, mesh, corners.color);
  for (const AttributeLayer& layer : attributes.layers) {
    const std::string& name = layer.type().name;
    const bool is_common = name == "TEXCOORD_0" || name == "NORMAL" || name == "COLOR_0";
    if (!is_common && !can.any_attribute) losses.push_back("attribute " + name);
  }
  if (!can.groups && !attributes.group.empty()) losses.emplace_back("groups");
  return losses;
}

}  // namespace mesher::io
