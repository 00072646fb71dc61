#pragma once

#include <cstdint>

#include "engine/mesh/mesh.h"
#include "engine/mesh/soup.h"

namespace mesher::bench {

/// What can be told of triangles without trusting that they are a manifold.
struct SurfaceDefects {
  std::uint32_t nonmanifold_edges = 0;    ///< of more than two faces
  std::uint32_t folded_edges = 0;         ///< of two faces whose normals differ by over 150 degrees
  std::int64_t euler_characteristic = 0;  ///< V - E + F, vertices without faces left out
};

/// Pre: triangles. O(F log F).
SurfaceDefects surface_defects(const Soup& soup);

/// A model to simplify, and what results are held against.
struct Reference {
  explicit Reference(Soup&& triangles);
  Soup soup;
  Mesh mesh;
  SurfaceDefects defects;
};

/// Two-sided distances of a result, in percent of the reference's diagonal, and its defects.
struct SurfaceQuality {
  double rms_percent = 0.0;
  double max_percent = 0.0;
  SurfaceDefects defects;
};

/// Pre: `result` has faces.
SurfaceQuality surface_quality(const Reference& reference, const Soup& result);

}  // namespace mesher::bench
