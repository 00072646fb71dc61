#include <mesher/asset.h>

#include "engine/io/losses.h"
#include "engine/io/pm_file.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "engine/library/asset_data.h"
#include "engine/library/watch.h"

namespace mesher {

Asset Asset::load(const std::filesystem::path& file, const LoadOptions& options) {
  Watch watch(options.progress);
  auto data = std::make_shared<Data>();
  if (io::is_pm_file(file)) {
    io::PmContents contents = io::read_pm_file(file, watch.progress());
    io::check_intact(file, contents.summary);
    data->model.attributes = contents.attributes.at_level(contents.mesh.mesh());
    data->model.materials = std::move(contents.materials);
    data->model.contents = std::move(contents.contents);
    data->model.mesh = std::move(contents.mesh.mesh());
  } else {
    data->model = io::read_model(file, {.crease_index_base = options.crease_index_base,
                                        .keep_isolated_vertices = options.keep_isolated_vertices,
                                        .weld = options.weld,
                                        .progress = watch.progress()});
  }
  return Asset(std::move(data));
}

std::vector<std::string> Asset::save(const std::filesystem::path& file,
                                     const SaveOptions& options) const {
  Watch watch(options.progress);
  const Model& model = data_->model;
  io::write_model(file, model.mesh, model.attributes,
                  {.ascii = options.ascii,
                   .compresses = options.compress,
                   .origin = model.origin,
                   .materials = model.materials,
                   .progress = watch.progress(),
                   .flush = options.fsync ? io::Flush::now : io::Flush::later});
  return io::losses_in_format(file, model.mesh, model.attributes, model.materials.get(),
                              model.contents, model.origin);
}

}  // namespace mesher
