#include "app/files/load_job.h"

#include <glm/trigonometric.hpp>
#include <memory>
#include <utility>

#include "app/files/journal.h"
#include "engine/core/error.h"
#include "engine/mesh/creases.h"

namespace mesher::app {
namespace {

/// Times of reading a model, and of its statistics: medians over six formats and 0.1, 1.4 and 13
/// million faces on two cores. (Statistics take 4 % after STL, 24 % after binary PLY.)
constexpr double kLoadWeights[] = {0.87, 0.13};
/// Times of loading, and of marking creases by angle and counting again.
constexpr double kRestoreWeights[] = {1.0, 0.1};
constexpr double kNoTagsWeights[] = {1.0, 0.0};

}  // namespace

LoadedModel open_model(const std::filesystem::path& file, const io::ReadOptions& options) {
  if (!io::is_pm_file(file)) return {io::read_model(file, options), {}, file, {}};
  io::PmContents contents = io::read_pm_file(file, options.progress);
  LoadedModel loaded{{}, {}, file, std::move(contents.summary)};
  loaded.model.name = file.filename().string();
  loaded.model.mesh = std::move(contents.mesh.mesh());
  return loaded;
}

namespace {

LoadedModel load(const std::filesystem::path& file, io::ReadOptions options, Progress& progress) {
  Stages stages(&progress, kLoadWeights);
  stages.next();
  options.progress = &progress;
  LoadedModel loaded = open_model(file, options);
  loaded.source = {.stamp = stamp_of(file),
                   .crease_index_base = options.crease_index_base,
                   .keep_isolated_vertices = options.keep_isolated_vertices,
                   .tag_creases_deg = std::nullopt};
  stages.next("counting");
  loaded.statistics = statistics(loaded.model.mesh, &progress);
  return loaded;
}

LoadedModel load_lost(LostEdits&& lost, Progress& progress) {
  Stages stages(&progress, lost.source.tag_creases_deg ? kRestoreWeights : kNoTagsWeights);
  stages.next();
  LoadedModel loaded = load(lost.file,
                            {.crease_index_base = lost.source.crease_index_base,
                             .keep_isolated_vertices = lost.source.keep_isolated_vertices},
                            progress);
  if (loaded.source.stamp != lost.source.stamp)
    throw InputError(lost.file.string(), 0, "has changed: its edits cannot be repeated");
  stages.next();
  if (lost.source.tag_creases_deg) {
    tag_creases_by_angle(loaded.model.mesh, glm::radians(*lost.source.tag_creases_deg));
    loaded.statistics = statistics(loaded.model.mesh, &progress);
  }
  loaded.source = lost.source;
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

LoadJob::LoadJob(const std::filesystem::path& file, const io::ReadOptions& options, void (*wake)())
    : JobOf(
          "Opening " + file.filename().string(),
          [file, options](Progress& progress) { return load(file, options, progress); }, wake),
      file_(file) {}

}  // namespace mesher::app
