#include <mesher/asset.h>
#include <mesher/error.h>

#include "engine/analysis/distance.h"
#include "engine/analysis/hausdorff.h"
#include "engine/library/asset_data.h"
#include "engine/library/watch.h"

namespace mesher {
namespace {

/// Times of bounding the distance, and of sampling it.
constexpr double kBoundAndSampleWeights[] = {0.6, 0.4};

/// Returns the mesh of a model about another origin.
Mesh about(const glm::dvec3& origin, const Model& model) {
  Mesh mesh = model.mesh;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const glm::dvec3 p(mesh.position(Vertex(v)));
    mesh.set_position(Vertex(v), glm::vec3(p + (model.origin - origin)));
  }
  return mesh;
}

}  // namespace

Comparison Asset::compare(const Asset& other, const CompareOptions& options) const {
  const Model& a = data_->model;
  const Model& b = other.data_->model;
  if (a.mesh.face_count() == 0 || b.mesh.face_count() == 0)
    throw InputError("compare: a surface has no faces");
  const bool is_moved = a.origin != b.origin;
  const Mesh moved = is_moved ? about(a.origin, b) : Mesh();
  const Mesh& second = is_moved ? moved : b.mesh;

  Watch watch(options.progress);
  Stages stages(watch.progress(), kBoundAndSampleWeights);
  stages.next("comparing");
  const auto certified =
      analysis::hausdorff_bounds(a.mesh, second, {.progress = watch.progress()}).two_sided();
  stages.next();
  const analysis::SurfaceDistance distance = analysis::surface_distance(
      a.mesh, second, {.samples = options.samples, .progress = watch.progress()});
  const analysis::OneSidedDistance both = distance.two_sided();
  return {.rms = both.rms,
          .mean = both.mean,
          .max = both.max,
          .upper_bound = certified.upper,
          .diagonal = distance.diagonal};
}

}  // namespace mesher
