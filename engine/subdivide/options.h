#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "engine/core/progress.h"

namespace mesher {

/// How new vertices are placed.
enum class Scheme : std::uint8_t {
  loop,       ///< C. Loop, "Smooth subdivision surfaces based on triangles", 1987; approximating
  butterfly,  ///< N. Dyn et al., 1990, modified by D. Zorin et al., 1996; interpolating
  midpoint,   ///< edges are halved and nothing moves
};
inline constexpr std::size_t kSchemeCount = 3;

/// What a sharp edge does to Loop's masks.
enum class CreaseRules : std::uint8_t {
  /// H. Hoppe et al., "Piecewise smooth surface reconstruction", 1994: darts, regular and
  /// non-regular creases, corners. Crease curves meet the smooth surface with continuous tangents.
  hoppe94,
  /// T. DeRose, M. Kass, T. Truong, "Subdivision surfaces in character animation", 1998, as
  /// OpenSubdiv has it: what modelling programs expect.
  derose98,
};
inline constexpr std::size_t kCreaseRulesCount = 2;

/// What a boundary does at a vertex with one face.
enum class BoundaryRounding : std::uint8_t {
  edge_only,        ///< the boundary is a smooth curve there, too
  edge_and_corner,  ///< such a vertex stays where it is
};
inline constexpr std::size_t kBoundaryRoundingCount = 2;

/// How the sharpness of a semi-sharp edge falls from level to level.
enum class CreaseDecay : std::uint8_t {
  uniform,  ///< by 1
  chaikin,  ///< averaged with its neighbours on the crease, then by 1
};
inline constexpr std::size_t kCreaseDecayCount = 2;

/// "loop", "hoppe94", "edge-only" ...: as the command line and JSON spell it.
std::string_view key(Scheme scheme);
std::string_view key(CreaseRules rules);
std::string_view key(BoundaryRounding boundary);
std::string_view key(CreaseDecay decay);

/// From this sharpness on an edge or vertex never gets smooth (as in OpenSubdiv).
inline constexpr float kSharpForEver = 10.0F;

/// By which rules to subdivide, and how far.
struct SubdivideOptions {
  std::uint32_t levels = 1;
  Scheme scheme = Scheme::loop;
  CreaseRules creases = CreaseRules::hoppe94;
  BoundaryRounding boundary = BoundaryRounding::edge_only;
  CreaseDecay decay = CreaseDecay::uniform;
  /// After the last level every vertex moves to where it goes in the end, and normals of the limit
  /// surface are made. With Loop only: the other schemes' vertices stay where they are.
  bool limit = false;
  Progress* progress = nullptr;
};

}  // namespace mesher
