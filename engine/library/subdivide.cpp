#include <mesher/asset.h>
#include <mesher/error.h>

#include "engine/core/memory.h"
#include "engine/library/asset_data.h"
#include "engine/library/watch.h"
#include "engine/mesh/wedges.h"
#include "engine/subdivide/attributes.h"
#include "engine/subdivide/subdivide.h"

namespace mesher {
namespace {

/// Times of subdividing a mesh and its attributes: as `mesher subdivide`.
constexpr double kSubdivideWeights[] = {0.35, 0.65};

subdivide::SubdivideOptions subdivide_options(const SubdivideOptions& options) {
  static_assert(int(Scheme::midpoint) == int(subdivide::Scheme::midpoint));
  static_assert(int(CreaseRules::derose98) == int(subdivide::CreaseRules::derose98));
  using subdivide::BoundaryRounding;
  using subdivide::CreaseDecay;
  using subdivide::UvInterpolation;
  return {.levels = options.levels,
          .scheme = static_cast<subdivide::Scheme>(options.scheme),
          .creases = static_cast<subdivide::CreaseRules>(options.creases),
          .boundary = options.keep_boundary_corners ? BoundaryRounding::edge_and_corner
                                                    : BoundaryRounding::edge_only,
          .decay = options.chaikin_decay ? CreaseDecay::chaikin : CreaseDecay::uniform,
          .uv = options.linear_texcoords ? UvInterpolation::linear : UvInterpolation::smooth,
          .limit = options.limit};
}

void check_size(const Model& model, const subdivide::SubdivideOptions& options) {
  const subdivide::SubdivisionSize size = subdivide::subdivision_size(model.mesh, options);
  const std::size_t beside =
      subdivide::subdivided_attribute_bytes(model.mesh, model.attributes, options);
  if (!size.has_ids) throw DeviceError("subdivide: the result has more elements than 32-bit ids");
  if (size.peak_bytes + beside > available_memory_bytes())
    throw DeviceError("subdivide: the result does not fit into memory");
}

}  // namespace

Asset Asset::subdivide(const SubdivideOptions& options) const {
  Watch watch(options.progress);
  const Model& coarse = data_->model;
  subdivide::SubdivideOptions engine = subdivide_options(options);
  engine.progress = watch.progress();
  check_size(coarse, engine);

  Stages stages(engine.progress, kSubdivideWeights);
  stages.next("subdividing");
  subdivide::Subdivided fine = subdivide::subdivide(coarse.mesh, engine);
  stages.next();
  auto data = std::make_shared<Data>(*data_);
  Model& model = data->model;
  model.attributes =
      subdivide::subdivide_attributes(coarse.mesh, coarse.attributes, fine.mesh, engine);
  model.mesh = std::move(fine.mesh);
  set_normals(model.mesh, model.attributes, fine.limit_normal);
  return Asset(std::move(data));
}

}  // namespace mesher
