#pragma once

#include <cstdint>

#include "engine/mesh/build/soup.h"
#include "engine/mesh/mesh.h"

namespace mesher::bench {

/// Defects of a list of triangles that need not be manifold.
struct SurfaceDefects {
  std::uint32_t nonmanifold_edges = 0;  ///< with more than two faces
  std::uint32_t folded_edges = 0;  ///< with two faces whose normals differ by more than 150 degrees
  std::int64_t euler_characteristic = 0;  ///< V - E + F, without vertices that no face uses
};

/// Pre: triangles. O(F log F).
SurfaceDefects surface_defects(const Soup& soup);

/// A model to simplify, as a reference for the results.
struct Reference {
  explicit Reference(Soup&& triangles);
  Soup soup;
  Mesh mesh;
  SurfaceDefects defects;
};

/// Two-sided distances of a result in percent of the diagonal of the reference, and its defects.
struct SurfaceQuality {
  double rms_percent = 0.0;
  double max_percent = 0.0;
  SurfaceDefects defects;
};

/// Pre: `result` has faces.
SurfaceQuality surface_quality(const Reference& reference, const Soup& result);

}  // namespace mesher::bench
