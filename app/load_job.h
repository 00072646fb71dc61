#pragma once

#include <filesystem>

#include "app/job.h"
#include "engine/io/read.h"
#include "engine/mesh/statistics.h"

namespace mesher::app {

/// A model with what was computed about it on the way.
struct LoadedModel {
  Model model;
  Statistics statistics;
  std::filesystem::path file;
};

/// Reads a model in the background. Its result throws what the reader throws (InputError).
class LoadJob : public JobOf<LoadedModel> {
 public:
  LoadJob(const std::filesystem::path& file, const ReadOptions& options, void (*wake)());

  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace mesher::app
