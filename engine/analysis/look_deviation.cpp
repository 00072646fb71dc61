#include "engine/analysis/look_deviation.h"

#include <algorithm>

#include "engine/analysis/color_difference.h"
#include "engine/analysis/normal_deviation.h"
#include "engine/analysis/surface_matches.h"
#include "engine/analysis/texture_deviation.h"
#include "engine/analysis/uv_slide.h"

namespace mesher::analysis {
namespace {

/// Times of finding the nearest points in each direction, and of all measures; 140,000 faces with
/// textures compared with a tenth of them.
constexpr double kLookWeights[] = {0.25, 0.25, 0.5};

/// Both surfaces with the nearest points of each other.
struct MatchedSurfaces {
  const AttributedSurface& a;
  const AttributedSurface& b;
  const TriangleTree& tree_a;
  SurfaceMatches forward;
  SurfaceMatches backward;
};

/// Says why something is not measured. Returns whether both surfaces have it.
bool both_have(bool first_has, bool second_has, const char* what, LookDeviation& look) {
  if (first_has && second_has) return true;
  const char* const who = first_has    ? "the second model has no "
                          : second_has ? "the first model has no "
                                       : "the models have no ";
  look.not_measured.push_back({what, who + std::string(what)});
  return false;
}

void measure_normals(const MatchedSurfaces& both, LookDeviation& look) {
  look.first_has_normals = ShadingNormals(both.a).is_of_file();
  look.second_has_normals = ShadingNormals(both.b).is_of_file();
  look.normals = {normal_deviation(both.a, both.b, both.forward),
                  normal_deviation(both.b, both.a, both.backward)};
  if (!look.normals->is_empty()) return;
  look.normals.reset();
  look.not_measured.push_back({"normals", "no faces have an area"});
}

/// Models may have texture coordinates that tell nothing: one color per face.
void leave_out_empty(LookDeviation& look) {
  if (look.uv_slide->is_empty()) {
    look.uv_slide.reset();
    look.not_measured.push_back({"UV slide", "no nearest points have texture coordinates"});
  }
  if (look.texture->is_empty()) {
    look.texture.reset();
    look.not_measured.push_back(
        {"texture deviation", "the models have no texture coordinates in common"});
  }
  if (look.stretch->mean.is_empty()) {
    look.stretch.reset();
    look.not_measured.push_back(
        {"UV stretch", "no faces near each other have texture coordinates with an area"});
  }
  if (!look.overlap->is_measured) {
    look.overlap.reset();
    look.not_measured.push_back({"UV overlap", "the second model covers no texture"});
  }
  if (look.flipped->compared == 0) {
    look.flipped.reset();
    look.not_measured.push_back(
        {"flipped UVs", "no faces near each other have texture coordinates with an area"});
  }
}

void measure_texture(const MatchedSurfaces& both, LookDeviation& look, Progress* progress) {
  if (!both_have(!UvLayers(both.a).is_empty(), !UvLayers(both.b).is_empty(), "texture coordinates",
                 look)) {
    return;
  }
  look.uv_slide = {uv_slide(both.a, both.b, both.forward, Reference::from),
                   uv_slide(both.b, both.a, both.backward, Reference::to)};
  check_cancelled(progress);
  TextureDeviation forward = texture_deviation(both.a, UvTree(both.b), both.forward);
  check_cancelled(progress);
  TextureDeviation backward = texture_deviation(both.b, UvTree(both.a), both.backward);
  look.texture_covered = std::min(forward.covered, backward.covered);
  look.texture = {std::move(forward.distances), std::move(backward.distances)};
  check_cancelled(progress);
  look.stretch = uv_stretch(both.a, both.b, both.backward);
  look.flipped = flipped_uvs(both.a, both.tree_a, both.b);
  check_cancelled(progress);
  look.overlap = uv_overlap(both.a, both.b, progress);
  leave_out_empty(look);
}

void measure_colors(const MatchedSurfaces& both, LookDeviation& look) {
  if (!both_have(has_vertex_colors(both.a), has_vertex_colors(both.b), "vertex colors", look))
    return;
  ColorDifference forward = color_difference(both.a, both.b, both.forward);
  ColorDifference backward = color_difference(both.b, both.a, both.backward);
  look.colors = {{std::move(forward.cie76), std::move(backward.cie76)},
                 {std::move(forward.ciede2000), std::move(backward.ciede2000)}};
}

}  // namespace

LookDeviation look_deviation(const AttributedSurface& a, const AttributedSurface& b,
                             const LookOptions& options) {
  MESHER_ASSERT(a.mesh.face_count() > 0 && b.mesh.face_count() > 0);
  const TriangleTree tree_a(a.mesh);
  const TriangleTree tree_b(b.mesh);
  Stages stages(options.progress, kLookWeights);
  stages.next("comparing the look");
  SurfaceMatches forward =
      match_surfaces(a.mesh, b.mesh, tree_b, options.samples, options.progress);
  stages.next();
  SurfaceMatches backward =
      match_surfaces(b.mesh, a.mesh, tree_a, options.samples, options.progress);
  stages.next();
  const MatchedSurfaces both{a, b, tree_a, std::move(forward), std::move(backward)};
  LookDeviation look;
  measure_normals(both, look);
  check_cancelled(options.progress);
  measure_texture(both, look, options.progress);
  check_cancelled(options.progress);
  measure_colors(both, look);
  return look;
}

}  // namespace mesher::analysis
