#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/core/choice.h"
#include "engine/core/option.h"
#include "engine/mesh/geomorph.h"
#include "engine/mesh/normals.h"

namespace mesher::render {

enum class Shading {
  none,     ///< no surface: with `wireframe`, only lines; hidden ones are faint
  flat,     ///< one normal per face
  gouraud,  ///< normals interpolated between corners
};

inline constexpr Choices<Shading, 3> kShadings{{
    {Shading::none, {"none", "none", "No surface: edges alone."}},
    {Shading::flat, {"flat", "flat", "One normal per face."}},
    {Shading::gouraud, {"gouraud", "Gouraud", "Normals interpolated over each face."}},
}};
static_assert(is_complete(kShadings));
constexpr const auto& choices(Shading) {
  return kShadings;
}

/// What the surface shows.
enum class Look {
  automatic,
  material,
  clay,
  base_color,
  normals,
  uv_checker,
};

inline constexpr Choices<Look, 6> kLooks{{
    {Look::automatic,
     {"auto", "automatic", "Materials if the model has any, or colors; otherwise clay."}},
    {Look::material,
     {"material", "material", "Materials and textures, under the light of a studio."}},
    {Look::clay, {"clay", "clay", "One color; blue at the back."}},
    {Look::base_color,
     {"base-color", "base color", "Base colors and their textures, without light."}},
    {Look::normals, {"normals", "normals", "Normals as colors: red is x, green y, blue z."}},
    {Look::uv_checker,
     {"uv-checker", "UV checker",
      "A checkerboard on the texture coordinates, eight squares per unit."}},
}};
static_assert(is_complete(kLooks));
constexpr const auto& choices(Look) {
  return kLooks;
}

enum class Background { light, dark };
inline constexpr Choices<Background, 2> kBackgrounds{{
    {Background::light, {"light", "light"}},
    {Background::dark, {"dark", "dark"}},
}};
static_assert(is_complete(kBackgrounds));
constexpr const auto& choices(Background) {
  return kBackgrounds;
}

/// An sRGB color with components 0 to 1, as in color pickers and CSS.
using Color = glm::vec3;

/// How to draw a scene. A plain value: compare it, copy it, save it to a file.
struct Settings {
  Shading shading = Shading::flat;
  /// Meshes without Sources::appearance are drawn as clay.
  Look look = Look::automatic;
  /// Draw edges: ordinary ones thin and faded where dense, creases yellow (semi-sharp ones thinner
  /// and paler), boundaries thick and red.
  bool wireframe = false;
  /// Draw creases and boundaries even without the wireframe.
  bool line_edges = false;
  /// Split Gouraud normals at edges whose face normals differ by more than this (180: only at
  /// tagged creases).
  float crease_angle_deg = 180.0F;
  /// Weights of the faces in Gouraud normals that are computed from the mesh. Normals that come
  /// with the model's limit surface or progressive mesh are used as they are.
  NormalWeight normal_weight = NormalWeight::angle;
  Background background = Background::light;
  Color front{0.80F, 0.78F, 0.74F};
  Color back{0.32F, 0.47F, 0.86F};  ///< blue: an inside-out surface is obvious
  Color crease{1.00F, 0.80F, 0.00F};
  Color boundary{0.90F, 0.05F, 0.05F};
  Color selected{0.00F, 0.62F, 0.93F};  ///< a band under the edge's own line
  Color hovered{0.55F, 0.85F, 1.00F};
  /// Samples per pixel, 1 or 4.
  unsigned samples = 4;
  /// Progress of the geomorph of growing splits. Ignored if the mirror has no MorphSource.
  GeomorphTime geomorph = GeomorphTime::done();
  /// Color the front by split order: `front` for vertices below `first_split_vertex`, then from
  /// violet (early) over green to yellow (late). The color advances by the same step whenever the
  /// number of vertices has doubled.
  bool colors_by_split_order = false;
  std::uint32_t first_split_vertex = 0;
  /// The number of splits that these colors are for; 0: those of the mesh that is drawn.
  std::uint32_t colored_splits = 0;

  friend bool operator==(const Settings&, const Settings&) = default;
};

/// Settings that commands and panels can change.
inline constexpr std::array kRenderOptions{
    Option<Settings>{.key = "shading",
                     .label = "shading",
                     .help = "how faces are shaded",
                     .member = enum_member<&Settings::shading>()},
    Option<Settings>{.key = "look",
                     .label = "look",
                     .help = "what the surface shows",
                     .member = enum_member<&Settings::look>(),
                     .applies = [](const Settings& s) { return s.shading != Shading::none; }},
    Option<Settings>{.key = "wireframe",
                     .label = "wireframe",
                     .help = "draw the edges",
                     .member = &Settings::wireframe},
    Option<Settings>{
        .key = "crease-angle",
        .label = "crease angle",
        .help = "split Gouraud normals at edges whose face normals differ by more than this",
        .member = &Settings::crease_angle_deg,
        .unit = "deg",
        .most = 180.0,
        .special = {180.0, "tagged only"},
        .applies = [](const Settings& s) { return s.shading == Shading::gouraud; }},
    Option<Settings>{.key = "normal-weight",
                     .label = "normal weight",
                     .help = "weights of the faces around a vertex in its Gouraud normal",
                     .member = enum_member<&Settings::normal_weight>(),
                     .applies = [](const Settings& s) { return s.shading == Shading::gouraud; }},
    Option<Settings>{.key = "background",
                     .label = "background",
                     .help = "color behind the model",
                     .member = enum_member<&Settings::background>()},
    Option<Settings>{.key = "samples",
                     .label = "samples",
                     .help = "samples per pixel, 1 or 4",
                     .member = &Settings::samples,
                     .least = 1.0,
                     .most = 4.0},
};

/// Returns the color behind the model.
Color background_color(Background background);
/// Returns the color of ordinary edges: dark over a surface; otherwise whatever contrasts with the
/// background.
Color edge_color(const Settings& settings);

}  // namespace mesher::render
