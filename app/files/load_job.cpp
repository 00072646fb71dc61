#include "app/files/load_job.h"

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
  begin_stage(&progress, "counting");
  loaded.statistics = statistics(loaded.model.mesh);
  return loaded;
}

}  // namespace

LoadJob::LoadJob(const std::filesystem::path& file, const io::ReadOptions& options, void (*wake)())
    : JobOf(
          "Opening " + file.filename().string(),
          [file, options](Progress& progress) { return load(file, options, progress); }, wake),
      file_(file) {}

}  // namespace mesher::app
