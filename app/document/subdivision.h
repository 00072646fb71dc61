#pragma once

#include <cstdint>
#include <memory>

#include "engine/mesh/shape.h"
#include "engine/subdivide/options.h"

namespace mesher::app {

/// A model that is `base`, subdivided `level` times by these rules. The base is kept, so that a
/// person can go to other levels and change the rules without loss.
struct SubdivisionLevel {
  std::shared_ptr<const Shape> base;
  std::uint32_t level = 0;
  subdivide::SubdivideOptions rules;  ///< those of kSubdivideRules
  std::uint32_t mesh = kNone;         ///< of the scene, which was subdivided; none: all
  /// Normals of the limit surface, one per corner; null: vertices were not moved to it.
  std::shared_ptr<const Array<glm::vec3>> limit_normals;
};

/// The finest level that a person can ask for: 4^12 faces per face.
inline constexpr std::uint32_t kMaxLevel = 12;

/// The result of the last subdivision.
struct SubdivideOutcome {
  std::uint32_t level = 0;
  std::uint32_t faces = 0;
  double seconds = 0.0;
};

}  // namespace mesher::app
