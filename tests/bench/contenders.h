#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "engine/mesh/build/soup.h"

namespace mesher::bench {

/// A simplifier from arrays to arrays: positions and corners of triangles in and out. The measured
/// time includes conversion to and from its own structures.
using SimplifyArrays = Soup (*)(Soup&& soup, std::uint32_t target_faces);

/// Includes half-edge construction, recording of all collapses and all threads.
Soup simplify_ours(Soup&& soup, std::uint32_t target_faces);
Soup simplify_ours_one_thread(Soup&& soup, std::uint32_t target_faces);
/// No limit on the error. Unused vertices are dropped.
Soup simplify_meshoptimizer(Soup&& soup, std::uint32_t target_faces);
/// Only the quadric module.
Soup simplify_openmesh(Soup&& soup, std::uint32_t target_faces);
/// P. Lindstrom, G. Turk, "Fast and memory efficient polygonal simplification", 1998. Rejects
/// collapses that turn a face by more than 90 degrees.
Soup simplify_cgal_lindstrom_turk(Soup&& soup, std::uint32_t target_faces);
/// M. Garland, P. Heckbert, "Surface simplification using quadric error metrics", 1997.
Soup simplify_cgal_garland_heckbert(Soup&& soup, std::uint32_t target_faces);

struct Contender {
  std::string_view name;
  SimplifyArrays simplify;
  bool is_slow = false;  ///< half a minute or more per million faces
};

/// All contenders, mesher first.
std::span<const Contender> contenders();

}  // namespace mesher::bench
