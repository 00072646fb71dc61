#include "app/load_job.h"

namespace mesher::app {
namespace {

LoadedModel load(const std::filesystem::path& file, ReadOptions options, Progress& progress) {
  options.progress = &progress;
  LoadedModel loaded{read_model(file, options), {}, file};
  begin_stage(&progress, "counting");
  loaded.statistics = statistics(loaded.model.mesh);
  return loaded;
}

}  // namespace

LoadJob::LoadJob(const std::filesystem::path& file, const ReadOptions& options, void (*wake)())
    : JobOf(
          "Opening " + file.filename().string(),
          [file, options](Progress& progress) { return load(file, options, progress); }, wake),
      file_(file) {}

}  // namespace mesher::app
