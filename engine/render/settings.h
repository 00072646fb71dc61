#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "engine/core/choice.h"
#include "engine/core/option.h"
#include "engine/mesh/geomorph.h"

namespace mesher::render {

enum class Shading {
  none,     ///< no surface: with `wireframe`, lines alone, hidden ones faintly
  flat,     ///< one normal a face
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

enum class Background { light, dark };
inline constexpr Choices<Background, 2> kBackgrounds{{
    {Background::light, {"light", "light"}},
    {Background::dark, {"dark", "dark"}},
}};
static_assert(is_complete(kBackgrounds));
constexpr const auto& choices(Background) {
  return kBackgrounds;
}

/// An sRGB color, components 0 to 1: as color pickers and CSS give them.
using Color = glm::vec3;

/// How a scene is drawn. Plain values: compare, copy, keep in a file.
struct Settings {
  Shading shading = Shading::flat;
  /// Edges: ordinary ones thin and faded where dense, creases yellow (semi-sharp ones thinner and
  /// paler), boundaries thick and red.
  bool wireframe = false;
  /// Creases and boundaries also where there is no wireframe.
  bool line_edges = false;
  /// Gouraud normals split where faces meet at more than this (180: only at tagged creases).
  float crease_angle_deg = 180.0F;
  Background background = Background::light;
  Color front{0.80F, 0.78F, 0.74F};
  Color back{0.32F, 0.47F, 0.86F};  ///< blue: a surface turned inside out is seen at once
  Color crease{1.00F, 0.80F, 0.00F};
  Color boundary{0.90F, 0.05F, 0.05F};
  Color selected{0.00F, 0.62F, 0.93F};  ///< a band under the line that the edge has anyway
  Color hovered{0.55F, 0.85F, 1.00F};
  /// Samples a pixel, 1 or 4.
  unsigned samples = 4;
  /// How far splits have grown that the mirror has a MorphSource for; without one it is ignored.
  GeomorphTime geomorph = GeomorphTime::done();
  /// The surface's front is colored by when a vertex came: `front` for those below
  /// `first_split_vertex`, from there on violet (early) over green to yellow (late), the same step
  /// each time that their number has doubled.
  bool colors_by_split_order = false;
  std::uint32_t first_split_vertex = 0;

  friend bool operator==(const Settings&, const Settings&) = default;
};

/// What commands and panels can change of it.
inline constexpr std::array kRenderOptions{
    Option<Settings>{.key = "shading",
                     .label = "shading",
                     .help = "how faces are shaded",
                     .member = enum_member<&Settings::shading>()},
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
        .special = {180.0, "at tagged creases only"},
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

/// The color behind the model.
Color background_color(Background background);
/// The color of ordinary edges: over a surface dark; alone, whatever reads on the background.
Color edge_color(const Settings& settings);

}  // namespace mesher::render
