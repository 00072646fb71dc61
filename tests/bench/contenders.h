#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "engine/mesh/soup.h"

namespace mesher::bench {

/// Somebody's simplification, from arrays to arrays: positions and the corners of triangles in and
/// out. Conversion into its own structures and back is part of the work.
using SimplifyArrays = Soup (*)(Soup&& soup, std::uint32_t target_faces);

/// Half-edge building, recording of all collapses and all threads included.
Soup simplify_ours(Soup&& soup, std::uint32_t target_faces);
Soup simplify_ours_one_thread(Soup&& soup, std::uint32_t target_faces);
/// With no limit on the error; the unused vertices are dropped.
Soup simplify_meshoptimizer(Soup&& soup, std::uint32_t target_faces);
/// Its quadric module alone.
Soup simplify_openmesh(Soup&& soup, std::uint32_t target_faces);
/// P. Lindstrom, G. Turk, "Fast and memory efficient polygonal simplification", 1998;
/// collapses that turn a face by more than 90 degrees refused.
Soup simplify_cgal_lindstrom_turk(Soup&& soup, std::uint32_t target_faces);
/// M. Garland, P. Heckbert, "Surface simplification using quadric error metrics", 1997.
Soup simplify_cgal_garland_heckbert(Soup&& soup, std::uint32_t target_faces);

struct Contender {
  std::string_view name;
  SimplifyArrays simplify;
  bool is_slow = false;  ///< half a minute or more for a million faces
};

/// Ours first.
std::span<const Contender> contenders();

}  // namespace mesher::bench
