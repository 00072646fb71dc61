#include "engine/analysis/look_deviation.h"

#include "engine/analysis/surface_matches.h"
#include "engine/analysis/uv_slide.h"

namespace mesher::analysis {
namespace {

/// Returns what the two surfaces lack, for users; empty if both have it.
std::string missing(bool first_has, bool second_has, const char* what) {
  if (first_has && second_has) return "";
  const char* const who = first_has    ? "the second model has no "
                          : second_has ? "the first model has no "
                                       : "the models have no ";
  return std::string(who) + what;
}

}  // namespace

LookDeviation look_deviation(const AttributedSurface& a, const AttributedSurface& b,
                             const LookOptions& options) {
  Stages stages(options.progress, {1.0, 1.0});
  stages.next("comparing looks");
  const TriangleTree tree_a(a.mesh);
  const TriangleTree tree_b(b.mesh);
  const SurfaceMatches forward =
      match_surfaces(a.mesh, b.mesh, tree_b, options.samples, options.progress);
  stages.next();
  const SurfaceMatches backward =
      match_surfaces(b.mesh, a.mesh, tree_a, options.samples, options.progress);
  LookDeviation look;
  const std::string no_uv =
      missing(!UvLayers(a).is_empty(), !UvLayers(b).is_empty(), "texture coordinates");
  if (no_uv.empty()) {
    look.uv_slide = TwoSidedSpread{uv_slide(a, b, forward, Reference::from),
                                   uv_slide(b, a, backward, Reference::to)};
  } else {
    look.not_measured.push_back("texture coordinates: " + no_uv);
  }
  return look;
}

}  // namespace mesher::analysis
