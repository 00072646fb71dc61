#pragma once

#include <filesystem>
#include <optional>

#include "engine/core/job.h"
#include "engine/io/pm_file.h"
#include "engine/io/read.h"
#include "engine/mesh/statistics.h"

namespace mesher::app {

/// A model with what was computed about it on the way.
struct LoadedModel {
  Model model;
  Statistics statistics;
  std::filesystem::path file;
  std::optional<PmSummary> pm;  ///< where the file holds a progressive mesh
};

/// Reads any model, a progressive mesh in full detail included (see is_pm_file); statistics are
/// not there yet. Throws as read_model and read_pm_file.
LoadedModel open_model(const std::filesystem::path& file, const ReadOptions& options);

/// Reads a model in the background. Its result throws what the reader throws (InputError).
class LoadJob : public JobOf<LoadedModel> {
 public:
  LoadJob(const std::filesystem::path& file, const ReadOptions& options, void (*wake)());

  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace mesher::app
