#pragma once

#include <array>
#include <cstdint>

#include "engine/core/choice.h"
#include "engine/core/option.h"
#include "engine/core/progress.h"

namespace mesher::subdivide {

/// How new vertices are placed.
enum class Scheme : std::uint8_t {
  loop,       ///< C. Loop, "Smooth subdivision surfaces based on triangles", 1987; approximating
  butterfly,  ///< N. Dyn et al., 1990, modified by D. Zorin et al., 1996; interpolating
  midpoint,   ///< edges are split in the middle and no vertex moves
};
inline constexpr Choices<Scheme, 3> kSchemes{{
    {Scheme::loop, {"loop", "Loop", "Smooth everywhere; approximates the vertices of the mesh."}},
    {Scheme::butterfly,
     {"butterfly", "butterfly", "Smooth, and interpolates the vertices of the mesh."}},
    {Scheme::midpoint,
     {"midpoint", "midpoint", "Splits edges in the middle: more triangles, the same surface."}},
}};
static_assert(is_complete(kSchemes));
constexpr const auto& choices(Scheme) {
  return kSchemes;
}

/// What the rest of the program must know of a scheme.
struct SchemeTraits {
  bool interpolates;      ///< the vertices of the mesh keep their positions
  bool has_limit;         ///< SubdivideOptions::limit has an effect
  bool has_crease_rules;  ///< SubdivideOptions::creases and ::boundary have an effect
};
constexpr SchemeTraits traits(Scheme scheme) {
  switch (scheme) {
    case Scheme::loop:
      return {.interpolates = false, .has_limit = true, .has_crease_rules = true};
    case Scheme::butterfly:
      return {.interpolates = true, .has_limit = false, .has_crease_rules = true};
    case Scheme::midpoint:
      return {.interpolates = true, .has_limit = false, .has_crease_rules = false};
  }
  return {};
}

/// How a sharp edge changes Loop's masks.
enum class CreaseRules : std::uint8_t {
  /// H. Hoppe et al., "Piecewise smooth surface reconstruction", 1994: darts, regular and
  /// non-regular creases, corners. Crease curves meet the smooth surface with continuous tangents.
  hoppe94,
  /// T. DeRose, M. Kass, T. Truong, "Subdivision surfaces in character animation", 1998, as in
  /// OpenSubdiv: the rules of most modeling programs.
  derose98,
};
inline constexpr Choices<CreaseRules, 2> kCreaseRules{{
    {CreaseRules::hoppe94,
     {"hoppe94", "Hoppe 1994",
      "Darts, regular and non-regular creases, corners: the surface is smooth up to both sides of "
      "a crease, and a crease ends smoothly."}},
    {CreaseRules::derose98,
     {"derose98", "DeRose 1998", "The rules of OpenSubdiv and most modeling programs."}},
}};
static_assert(is_complete(kCreaseRules));
constexpr const auto& choices(CreaseRules) {
  return kCreaseRules;
}

/// How the boundary is treated at a vertex with one face.
enum class BoundaryRounding : std::uint8_t {
  edge_only,        ///< the boundary is a smooth curve there as well
  edge_and_corner,  ///< such a vertex keeps its position
};
inline constexpr Choices<BoundaryRounding, 2> kBoundaryRoundings{{
    {BoundaryRounding::edge_only,
     {"edge-only", "edge only", "The boundary is a smooth curve, also at vertices with one face."}},
    {BoundaryRounding::edge_and_corner,
     {"edge-and-corner", "edge and corner", "A boundary vertex with one face keeps its position."}},
}};
static_assert(is_complete(kBoundaryRoundings));
constexpr const auto& choices(BoundaryRounding) {
  return kBoundaryRoundings;
}

/// How the sharpness of a semi-sharp edge decreases from level to level.
enum class CreaseDecay : std::uint8_t {
  uniform,  ///< by 1
  chaikin,  ///< averaged with its neighbors on the crease, then by 1
};
inline constexpr Choices<CreaseDecay, 2> kCreaseDecays{{
    {CreaseDecay::uniform, {"uniform", "uniform", "Semi-sharp edges lose 1 per level."}},
    {CreaseDecay::chaikin,
     {"chaikin", "Chaikin",
      "The sharpness of semi-sharp edges is averaged along the crease, then decreases by 1."}},
}};
static_assert(is_complete(kCreaseDecays));
constexpr const auto& choices(CreaseDecay) {
  return kCreaseDecays;
}

/// How texture coordinates are subdivided.
enum class UvInterpolation : std::uint8_t {
  smooth,  ///< by the scheme, like positions, within each chart
  linear,  ///< along edges within each face
};
inline constexpr Choices<UvInterpolation, 2> kUvInterpolations{{
    {UvInterpolation::smooth,
     {"smooth", "smooth",
      "Texture coordinates follow the scheme within each chart, so that textures move with the "
      "surface; seams are creases."}},
    {UvInterpolation::linear,
     {"linear", "linear", "Texture coordinates are interpolated linearly within each face."}},
}};
static_assert(is_complete(kUvInterpolations));
constexpr const auto& choices(UvInterpolation) {
  return kUvInterpolations;
}

/// An edge or vertex of this sharpness or more never becomes smooth (as in OpenSubdiv).
inline constexpr float kSharpForEver = 10.0F;

/// The number of levels and the rules of a subdivision.
struct SubdivideOptions {
  std::uint32_t levels = 1;
  Scheme scheme = Scheme::loop;
  CreaseRules creases = CreaseRules::hoppe94;
  BoundaryRounding boundary = BoundaryRounding::edge_only;
  CreaseDecay decay = CreaseDecay::uniform;
  UvInterpolation uv = UvInterpolation::smooth;
  /// Moves every vertex to its limit position after the last level, and computes the normals of the
  /// limit surface. No effect unless the scheme `has_limit`.
  bool limit = false;
  Progress* progress = nullptr;

  friend bool operator==(const SubdivideOptions&, const SubdivideOptions&) = default;
};

/// The rules of subdivision, which the command and the panel take.
inline constexpr std::array kSubdivideRules{
    Option<SubdivideOptions>{.key = "scheme",
                             .label = "scheme",
                             .help = "how new vertices are placed",
                             .member = enum_member<&SubdivideOptions::scheme>()},
    Option<SubdivideOptions>{
        .key = "creases",
        .label = "creases",
        .help = "rules for sharp edges",
        .member = enum_member<&SubdivideOptions::creases>(),
        .applies = [](const SubdivideOptions& o) { return traits(o.scheme).has_crease_rules; }},
    Option<SubdivideOptions>{
        .key = "boundary",
        .label = "boundary",
        .help = "whether boundary vertices with one face keep their position",
        .member = enum_member<&SubdivideOptions::boundary>(),
        .applies = [](const SubdivideOptions& o) { return traits(o.scheme).has_crease_rules; }},
    Option<SubdivideOptions>{.key = "crease-decay",
                             .label = "crease decay",
                             .help = "how the sharpness of semi-sharp edges decreases per level",
                             .member = enum_member<&SubdivideOptions::decay>()},
    Option<SubdivideOptions>{
        .key = "uv",
        .label = "uv",
        .help = "how texture coordinates are subdivided",
        .member = enum_member<&SubdivideOptions::uv>(),
        .applies = [](const SubdivideOptions& o) { return o.scheme != Scheme::midpoint; }},
    Option<SubdivideOptions>{
        .key = "limit",
        .label = "limit surface",
        .help = "move the vertices to the limit surface, and compute its normals (Loop only)",
        .member = &SubdivideOptions::limit,
        .applies = [](const SubdivideOptions& o) { return traits(o.scheme).has_limit; }},
};

}  // namespace mesher::subdivide
