#include "engine/subdivide/loop.h"

#include "engine/subdivide/sharp_step.h"
#include "engine/subdivide/smooth_step.h"

namespace mesher::subdivide {

Level loop_step(const LevelView& coarse, const Rings& rings, const Features& features,
                const SubdivideOptions& options, bool is_last) {
  Level finer = smooth_step(coarse, rings, is_last, options.progress);
  place_sharp(coarse, features, options, finer);
  return finer;
}

}  // namespace mesher::subdivide
