#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/choice.h"

namespace mesher {

/// The kinds of content that a file may hold besides positions and faces.
enum class Content : std::uint8_t {
  points,
  lines,
  curves,  ///< free-form curves and surfaces
  uv_sets,
  normals,
  tangents,
  color_sets,
  joint_sets,  ///< joints and weights of a skin
  groups,
  objects,
  smoothing_groups,
  materials,
  material_files,
  textures,
  nodes,  ///< that hold a mesh, a camera or a light, or have children
  instances,
  skins,
  animations,
  morph_targets,
  cameras,
  lights,
  variants,
  extensions,
  extras,
  own_properties,  ///< elements, attributes and statements that mesher does not know
};
/// The labels are phrases for count_phrase.
inline constexpr Choices<Content, 25> kContents{{
    {Content::points, {"points", "{point|points}"}},
    {Content::lines, {"lines", "{line|lines}"}},
    {Content::curves, {"curves", "free-form {curve or surface|curves and surfaces}"}},
    {Content::uv_sets, {"uv_sets", "UV {set|sets}"}},
    {Content::normals, {"normals", "{set|sets} of normals"}},
    {Content::tangents, {"tangents", "{set|sets} of tangents"}},
    {Content::color_sets, {"color_sets", "color {set|sets}"}},
    {Content::joint_sets, {"joint_sets", "{set|sets} of joints and weights"}},
    {Content::groups, {"groups", "{group|groups}"}},
    {Content::objects, {"objects", "{object|objects}"}},
    {Content::smoothing_groups, {"smoothing_groups", "smoothing {group|groups}"}},
    {Content::materials, {"materials", "{material|materials}"}},
    {Content::material_files, {"material_files", "material {file|files}"}},
    {Content::textures, {"textures", "{texture|textures}"}},
    {Content::nodes, {"nodes", "{node|nodes}"}},
    {Content::instances, {"instances", "{instance|instances}"}},
    {Content::skins, {"skins", "{skin|skins}"}},
    {Content::animations, {"animations", "{animation|animations}"}},
    {Content::morph_targets, {"morph_targets", "morph {target|targets}"}},
    {Content::cameras, {"cameras", "{camera|cameras}"}},
    {Content::lights, {"lights", "{light|lights}"}},
    {Content::variants, {"variants", "material {variant|variants}"}},
    {Content::extensions, {"extensions", "{extension|extensions}"}},
    {Content::extras, {"extras", "{value|values} of extras"}},
    {Content::own_properties, {"own_properties", "own {property|properties}"}},
}};
static_assert(is_complete(kContents));
constexpr const auto& choices(Content) {
  return kContents;
}

/// What a reader saw in a file: the number of each kind of content, and names. The reader counts
/// everything, also what mesher does not carry over.
class FileContents {
 public:
  /// Limit on the names of a kind; further ones are only counted.
  static constexpr std::size_t kMostNames = 64;
  static constexpr std::size_t kMostNameBytes = 256;

  std::uint64_t& operator[](Content kind) { return counts_[static_cast<std::size_t>(kind)]; }
  std::uint64_t operator[](Content kind) const { return counts_[static_cast<std::size_t>(kind)]; }

  /// Returns a name as it is kept: truncated, and with control characters replaced.
  static std::string readable(std::string_view name);
  /// Notes the type of an attribute, once for each text: "TEXCOORD_0: 2 x u16, normalized". Keeps
  /// at most kMostNames.
  void note_attribute(const std::string& text);
  const std::vector<std::string>& attributes() const { return attributes_; }

  /// Counts one and keeps its name. O(length).
  void add(Content kind, std::string_view name);
  /// Returns the names of a kind in the order of the file; there may be fewer than its count.
  const std::vector<std::string>& names(Content kind) const {
    return names_[static_cast<std::size_t>(kind)];
  }
  /// Returns a phrase of count and names: "2 own properties: quality, label".
  std::string phrase(Content kind) const { return phrase(kind, (*this)[kind]); }
  /// As above with another count.
  std::string phrase(Content kind, std::uint64_t count) const;

  /// Adds a line about a file beside this one that could not be used as it should, made readable
  /// like a name. Keeps kMostNames of them.
  void warn(std::string_view line);
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::vector<std::string> attributes_;
  std::array<std::uint64_t, kContents.size()> counts_{};
  std::array<std::vector<std::string>, kContents.size()> names_;
  std::vector<std::string> warnings_;
};

}  // namespace mesher
