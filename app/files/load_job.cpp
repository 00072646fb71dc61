#include "app/files/load_job.h"

#include <glm/trigonometric.hpp>
#include <memory>
#include <utility>

#include "app/document/stand_in.h"
#include "app/files/journal.h"
#include "engine/core/error.h"
#include "engine/mesh/creases.h"

namespace mesher::app {
namespace {

/// Times of reading a model, and of its statistics: medians over six formats and 0.1, 1.4 and 13
/// million faces on two cores. (Statistics take 4 % after STL, 24 % after binary PLY.)
/// Then that of the stand-in, which only large models get: 0.12 s for 11.8 million faces of a
/// binary PLY, which takes 1.3 s to read and 0.3 s to count.
constexpr double kLoadWeights[] = {0.87, 0.13, 0.06};

}  // namespace

LoadedModel open_model(const std::filesystem::path& file, const io::ReadOptions& options) {
  if (!io::is_pm_file(file)) return {io::read_model(file, options), {}, file, {}};
  io::PmContents contents = io::read_pm_file(file, options.progress);
  LoadedModel loaded{{}, {}, file, std::move(contents.summary)};
  loaded.model.name = file.filename().string();
  loaded.model.attributes = contents.attributes.at_level(contents.mesh.mesh());
  loaded.model.materials = std::move(contents.materials);
  loaded.model.contents = std::move(contents.contents);
  loaded.model.mesh = std::move(contents.mesh.mesh());
  return loaded;
}

LoadedModel load_model(const std::filesystem::path& file, LoadOptions options, Progress& progress) {
  Stages stages(&progress, kLoadWeights);
  stages.next();
  options.read.progress = &progress;
  options.read.keeps_scene = true;
  LoadedModel loaded = open_model(file, options.read);
  loaded.source = {.stamp = stamp_of(file),
                   .crease_index_base = options.read.crease_index_base,
                   .keep_isolated_vertices = options.read.keep_isolated_vertices,
                   .weld = options.read.weld,
                   .tag_creases_deg = options.tag_creases_deg};
  if (options.tag_creases_deg)
    tag_creases_by_angle(loaded.model.mesh, glm::radians(*options.tag_creases_deg));
  stages.next("counting");
  loaded.statistics = scene::statistics(loaded.model.mesh, loaded.model.attributes,
                                        loaded.model.scene.get(), &progress);
  stages.next();
  if (loaded.statistics.faces > kStandInFrom)
    loaded.stand_in = make_stand_in(loaded.model.mesh, loaded.statistics);
  return loaded;
}

namespace {

LoadedModel load_lost(LostEdits&& lost, Progress& progress) {
  const ModelSource& source = lost.source;
  LoadedModel loaded = load_model(lost.file,
                                  {.read = {.crease_index_base = source.crease_index_base,
                                            .keep_isolated_vertices = source.keep_isolated_vertices,
                                            .weld = source.weld},
                                   .tag_creases_deg = source.tag_creases_deg},
                                  progress);
  if (loaded.source.stamp != source.stamp)
    throw InputError(lost.file.string(), 0, "has changed: its edits cannot be repeated");
  loaded.lost = std::move(lost);
  return loaded;
}

}  // namespace

LoadJob::LoadJob(LostEdits&& lost, void (*wake)())
    : JobOf(
          "Restoring " + lost.file.filename().string(),
          [lost = std::make_shared<LostEdits>(lost)](Progress& progress) {
            return load_lost(std::move(*lost), progress);
          },
          wake),
      file_(lost.file) {}

LoadJob::LoadJob(const std::filesystem::path& file, const LoadOptions& options, void (*wake)())
    : JobOf(
          "Opening " + file.filename().string(),
          [file, options](Progress& progress) { return load_model(file, options, progress); },
          wake),
      file_(file) {}

}  // namespace mesher::app
