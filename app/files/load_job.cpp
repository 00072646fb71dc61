#include "app/files/load_job.h"

#include <glm/trigonometric.hpp>
#include <memory>
#include <utility>

#include "app/files/journal.h"
#include "engine/core/error.h"
#include "engine/mesh/creases.h"

namespace mesher::app {

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
  options.progress = &progress;
  LoadedModel loaded = open_model(file, options);
  loaded.source = {.stamp = stamp_of(file),
                   .crease_index_base = options.crease_index_base,
                   .keep_isolated_vertices = options.keep_isolated_vertices,
                   .tag_creases_deg = std::nullopt};
  begin_stage(&progress, "counting");
  loaded.statistics = statistics(loaded.model.mesh);
  return loaded;
}

LoadedModel load_lost(LostEdits&& lost, Progress& progress) {
  LoadedModel loaded = load(lost.file,
                            {.crease_index_base = lost.source.crease_index_base,
                             .keep_isolated_vertices = lost.source.keep_isolated_vertices},
                            progress);
  if (loaded.source.stamp != lost.source.stamp)
    throw InputError(lost.file.string(), 0, "has changed: its edits cannot be repeated");
  if (lost.source.tag_creases_deg) {
    tag_creases_by_angle(loaded.model.mesh, glm::radians(*lost.source.tag_creases_deg));
    loaded.statistics = statistics(loaded.model.mesh);
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
