#include "engine/subdivide/subdivide.h"

#include <utility>

#include "engine/core/assert.h"
#include "engine/core/parallel.h"
#include "engine/subdivide/features.h"
#include "engine/subdivide/loop.h"
#include "engine/subdivide/rings.h"
#include "engine/subdivide/smooth_step.h"

namespace mesher {
namespace {

/// Steps down the levels from a mesh. The last level of `run` may do without connectivity.
class Subdivision {
 public:
  Subdivision(const Mesh& mesh, const SubdivideOptions& options)
      : options_(options),
        coarse_(view_of(mesh)),
        rings_(coarse_, needs_spokes()),
        features_(features_of(mesh, options)) {}

  void run(bool wants_mesh) {
    for (std::uint32_t i = 1; i <= options_.levels; ++i) {
      begin_stage(options_.progress, "subdividing, level " + std::to_string(i) + " of " +
                                         std::to_string(options_.levels));
      const bool is_bare = i == options_.levels && !wants_mesh;
      Level finer = loop_step(coarse_, rings_, features_, options_, is_bare);
      rings_.descend(coarse_.vertex_count());
      if (!is_bare) features_ = next_features(features_, finer, options_);
      level_ = std::move(finer);
      coarse_ = level_.view();
    }
  }

  Level& level() { return level_; }
  const Features& features() const { return features_; }

 private:
  const SubdivideOptions& options_;
  LevelView coarse_;
  Rings rings_;
  Level level_;
  Features features_;
};

template <class T>
Array<T> copy_of(std::span<const T> values) {
  return Array<T>(values.begin(), values.end());
}

}  // namespace

IndexedTriangles subdivide_to_triangles(const Mesh& mesh, const SubdivideOptions& options) {
  if (options.levels == 0) return {copy_of(mesh.positions()), copy_of(mesh.origins())};
  Subdivision subdivision(mesh, options);
  subdivision.run(false);
  return {std::move(subdivision.level().position), std::move(subdivision.level().origin)};
}

}  // namespace mesher
