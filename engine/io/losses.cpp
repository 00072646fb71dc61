#include "engine/io/losses.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/core/text.h"
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

/// How many of a kind of content the mesh carries to a writer.
enum class CarriedSets {
  none,        ///< readers only count it
  first,       ///< one set, if the mesh has it; whether a format holds it says FormatContents
  all_if_any,  ///< all, if the mesh has them; as above
};

/// The table of kinds: a kind that mesher begins to carry over gets another entry here, and a
/// member of FormatContents.
struct ContentRow {
  Content kind;
  CarriedSets carried;
  /// Returns whether the mesh has it. Null: never.
  bool (*has)(const Attributes& attributes) = nullptr;
};
constexpr ContentRow kRows[] = {
    {Content::points, CarriedSets::none},
    {Content::lines, CarriedSets::none},
    {Content::curves, CarriedSets::none},
    {Content::uv_sets, CarriedSets::first,
     [](const Attributes& a) { return a.find(AttributeKind::texcoord) != nullptr; }},
    {Content::normals, CarriedSets::first,
     [](const Attributes& a) { return a.find(AttributeKind::normal) != nullptr; }},
    {Content::tangents, CarriedSets::none},
    {Content::color_sets, CarriedSets::first,
     [](const Attributes& a) { return a.find(AttributeKind::color) != nullptr; }},
    {Content::joint_sets, CarriedSets::none},
    {Content::groups, CarriedSets::all_if_any,
     [](const Attributes& a) { return !a.group.empty(); }},
    {Content::objects, CarriedSets::none},
    {Content::smoothing_groups, CarriedSets::none},
    {Content::materials, CarriedSets::none},
    {Content::material_files, CarriedSets::none},
    {Content::textures, CarriedSets::none},
    {Content::nodes, CarriedSets::none},
    {Content::instances, CarriedSets::none},
    {Content::skins, CarriedSets::none},
    {Content::animations, CarriedSets::none},
    {Content::morph_targets, CarriedSets::none},
    {Content::cameras, CarriedSets::none},
    {Content::lights, CarriedSets::none},
    {Content::variants, CarriedSets::none},
    {Content::extensions, CarriedSets::none},
    {Content::extras, CarriedSets::none},
    {Content::own_properties, CarriedSets::none},
};

constexpr bool has_all_rows() {
  for (std::size_t i = 0; i < std::size(kRows); ++i) {
    if (static_cast<std::size_t>(kRows[i].kind) != i) return false;
  }
  return std::size(kRows) == kContents.size();
}
static_assert(has_all_rows());

void add_contents(std::vector<std::string>& losses, const Attributes& attributes,
                  const FileContents& contents) {
  for (const ContentRow& row : kRows) {
    const std::uint64_t count = contents[row.kind];
    const bool is_carried = row.has != nullptr && row.has(attributes);
    std::uint64_t carried = 0;
    if (is_carried)
      carried = row.carried == CarriedSets::first ? std::min<std::uint64_t>(1, count) : count;
    if (count == carried) continue;
    losses.push_back((carried > 0 ? "all but one of " : "") + contents.phrase(row.kind));
  }
}

std::string far_text(const glm::dvec3& origin) {
  return "digits of coordinates (they are about " + number_text(origin.x) + ", " +
         number_text(origin.y) + ", " + number_text(origin.z) + ")";
}

}  // namespace

std::vector<std::string> losses_in_format(const std::filesystem::path& file, const Mesh& mesh,
                                          const Attributes& attributes,
                                          const FileContents& contents, const glm::dvec3& origin) {
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
  if (!can.far_positions && origin != glm::dvec3(0.0)) losses.push_back(far_text(origin));
  add_contents(losses, attributes, contents);
  return losses;
}

}  // namespace mesher::io
