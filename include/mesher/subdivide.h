#pragma once

/// @file
/// @brief Options of a subdivision.

#include <mesher/progress.h>

#include <cstdint>

namespace mesher {

/// How new vertices are placed.
enum class Scheme {
  loop,       ///< C. Loop 1987: smooth, approximates the vertices
  butterfly,  ///< N. Dyn et al. 1990, D. Zorin et al. 1996: smooth, interpolates the vertices
  midpoint,   ///< in the middle of edges; no vertex moves
};

/// How a sharp edge changes the masks of Loop's scheme.
enum class CreaseRules {
  hoppe94,   ///< H. Hoppe et al. 1994: smooth up to both sides of a crease
  derose98,  ///< T. DeRose et al. 1998, as in OpenSubdiv
};

/// The number of levels and the rules of a subdivision.
struct SubdivideOptions {
  /// Each level has four times the faces of the one before. Pre: at most 16.
  std::uint32_t levels = 1;
  Scheme scheme = Scheme::loop;                ///< how new vertices are placed
  CreaseRules creases = CreaseRules::hoppe94;  ///< what sharp edges do
  bool keep_boundary_corners = false;          ///< boundary vertices with one face do not move
  bool chaikin_decay = false;                  ///< average sharpness along semi-sharp creases
  bool linear_texcoords = false;               ///< do not smooth texture coordinates
  /// Move the vertices to the limit surface after the last level, and store its normals. Loop only;
  /// the other schemes ignore it.
  bool limit = false;
  ProgressCallback progress{};  ///< may be empty
};

}  // namespace mesher
