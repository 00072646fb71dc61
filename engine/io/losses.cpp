#include "engine/io/losses.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>

#include "engine/core/text.h"
#include "engine/io/format.h"
#include "engine/io/material_losses.h"
#include "engine/io/obj_groups.h"
#include "engine/io/ply_textures.h"
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

/// What a format keeps, and of what.
struct Keeper {
  const FormatContents& can;
  const Attributes& attributes;
  std::vector<FaceGroup> groups;  ///< those with faces
  const Materials* materials;     ///< null if there are none, or the format has none
  std::uint64_t textures;         ///< those of the file that the format holds
  const FileContents& contents;
};

/// Returns what is not kept of the contents of one kind. The names and counts of another kind do
/// not matter.
using LostOf = FileContents (*)(const Keeper& keeper, Content kind);

FileContents all_but(const FileContents& contents, Content kind, std::uint64_t kept) {
  FileContents lost;
  if (contents[kind] <= kept) return lost;
  if (kept == 0) return contents;
  lost[kind] = contents[kind] - kept;
  return lost;
}

FileContents all(const Keeper& keeper, Content) {
  return keeper.contents;
}

/// One set is kept, if the mesh has it. Whether the format holds it says FormatContents.
template <AttributeKind attribute>
FileContents all_but_first(const Keeper& keeper, Content kind) {
  const bool is_kept = keeper.attributes.find(attribute) != nullptr;
  return all_but(keeper.contents, kind, is_kept ? 1 : 0);
}

/// Returns the contents without those that are named.
FileContents all_but_named(const FileContents& contents, Content kind,
                           const std::set<std::string, std::less<>>& kept) {
  FileContents lost;
  for (const std::string& name : contents.names(kind)) {
    if (!kept.contains(name)) lost.add(kind, name);
  }
  const std::uint64_t known = contents.names(kind).size();
  const std::uint64_t matched = known - lost[kind];
  const std::uint64_t unknown = contents[kind] - known;
  lost[kind] += unknown - std::min<std::uint64_t>(unknown, kept.size() - matched);
  return lost;
}

/// The names of a kind that the groups have.
template <std::string FaceGroup::*name>
FileContents all_but_groups(const Keeper& keeper, Content kind) {
  std::set<std::string, std::less<>> kept;
  if (!keeper.can.groups) return keeper.contents;
  for (const FaceGroup& group : keeper.groups) {
    const bool is_off = name == &FaceGroup::smoothing && is_smoothing_off(group.smoothing);
    if (!(group.*name).empty() && !is_off) kept.insert(FileContents::readable(group.*name));
  }
  return all_but_named(keeper.contents, kind, kept);
}

FileContents lost_materials(const Keeper& keeper, Content) {
  return keeper.materials == nullptr ? keeper.contents : FileContents();
}

/// Other formats take over what the files say, but a missing file says nothing.
FileContents lost_material_files(const Keeper& keeper, Content kind) {
  if (keeper.materials == nullptr) return keeper.contents;
  FileContents lost;
  if (keeper.can.materials == HoldsMaterials::as_mtl) return lost;
  for (const std::string& name : keeper.materials->missing_files)
    lost.add(kind, name);
  return lost;
}

FileContents lost_textures(const Keeper& keeper, Content kind) {
  return all_but(keeper.contents, kind, keeper.textures);
}

std::uint64_t count_held_textures(const Materials* materials, HoldsMaterials holds) {
  if (materials == nullptr || holds == HoldsMaterials::nothing) return 0;
  if (holds != HoldsMaterials::color_textures) return materials->texture_count;
  return std::min<std::uint64_t>(materials->texture_count, ply_textures(*materials).images.size());
}

/// Extensions of materials that struct Material has terms for.
FileContents lost_extensions(const Keeper& keeper, Content kind) {
  if (keeper.materials == nullptr) return keeper.contents;
  return all_but_named(
      keeper.contents, kind,
      {"EXT_texture_webp", "KHR_materials_emissive_strength", "KHR_materials_unlit",
       "KHR_texture_basisu", "KHR_texture_transform", "MSFT_texture_dds"});
}

/// The table of kinds: a kind that mesher begins to carry over gets another function here, and a
/// member of FormatContents.
struct ContentRow {
  Content kind;
  LostOf lost = all;
};
constexpr ContentRow kRows[] = {
    {Content::points},
    {Content::lines},
    {Content::curves},
    {Content::uv_sets, all_but_first<AttributeKind::texcoord>},
    {Content::normals, all_but_first<AttributeKind::normal>},
    {Content::tangents},
    {Content::color_sets, all_but_first<AttributeKind::color>},
    {Content::joint_sets},
    {Content::groups, all_but_groups<&FaceGroup::name>},
    {Content::objects, all_but_groups<&FaceGroup::object>},
    {Content::smoothing_groups, all_but_groups<&FaceGroup::smoothing>},
    {Content::materials, lost_materials},
    {Content::material_files, lost_material_files},
    {Content::textures, lost_textures},
    {Content::nodes},
    {Content::instances},
    {Content::skins},
    {Content::animations},
    {Content::morph_targets},
    {Content::cameras},
    {Content::lights},
    {Content::variants},
    {Content::extensions, lost_extensions},
    {Content::extras},
    {Content::own_properties},
};

constexpr bool has_all_rows() {
  for (std::size_t i = 0; i < std::size(kRows); ++i) {
    if (static_cast<std::size_t>(kRows[i].kind) != i) return false;
  }
  return std::size(kRows) == kContents.size();
}
static_assert(has_all_rows());

void add_contents(std::vector<std::string>& losses, const Keeper& keeper) {
  for (const ContentRow& row : kRows) {
    if (keeper.contents[row.kind] == 0) continue;
    const FileContents lost = row.lost(keeper, row.kind);
    if (lost[row.kind] == 0) continue;
    const bool is_one_kept = keeper.contents[row.kind] == lost[row.kind] + 1;
    losses.push_back(is_one_kept && lost.names(row.kind).empty()
                         ? "all but one of " + keeper.contents.phrase(row.kind)
                         : lost.phrase(row.kind));
  }
}

/// A simplification may leave a group without faces.
std::vector<FaceGroup> groups_with_faces(const Attributes& attributes) {
  std::vector<bool> has_faces(attributes.groups.size(), false);
  for (const std::uint32_t group : attributes.group)
    has_faces[group] = true;
  std::vector<FaceGroup> groups;
  for (std::size_t g = 0; g < attributes.groups.size(); ++g) {
    if (has_faces[g]) groups.push_back(attributes.groups[g]);
  }
  return groups;
}

std::string far_text(const glm::dvec3& origin) {
  return "digits of coordinates (they are about " + number_text(origin.x) + ", " +
         number_text(origin.y) + ", " + number_text(origin.z) + ")";
}

std::vector<std::string> losses_by(const FormatContents& can, const Mesh& mesh,
                                   const Attributes& attributes, const Materials* materials,
                                   const FileContents& contents, const glm::dvec3& origin) {
  std::vector<std::string> losses;
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
  if (!can.far_positions && origin != glm::dvec3(0.0)) losses.push_back(far_text(origin));
  const std::uint64_t textures = count_held_textures(materials, can.materials);
  if (!holds_look(can.materials)) materials = nullptr;
  add_contents(losses,
               {can, attributes, groups_with_faces(attributes), materials, textures, contents});
  if (materials != nullptr)
    std::ranges::copy(material_losses(*materials, can.materials, count_uv_sets(attributes)),
                      std::back_inserter(losses));
  return losses;
}

}  // namespace

std::vector<std::string> losses_in_format(const std::filesystem::path& file, const Mesh& mesh,
                                          const Attributes& attributes, const Materials* materials,
                                          const FileContents& contents, const glm::dvec3& origin) {
  const FormatInfo* format = format_of(file);
  if (format == nullptr) return {};
  FormatContents can = format->holds;
  can.materials = held_materials(*format, file);
  return losses_by(can, mesh, attributes, materials, contents, origin);
}

}  // namespace mesher::io
