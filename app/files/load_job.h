#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "app/document/lost_edits.h"
#include "app/document/model_source.h"
#include "engine/core/job.h"
#include "engine/io/pm_file.h"
#include "engine/io/read.h"
#include "engine/mesh/statistics.h"

namespace mesher::app {

/// A model with its statistics.
struct LoadedModel {
  Model model;
  Statistics statistics;
  std::filesystem::path file;
  std::optional<io::PmSummary> pm;  ///< if the file holds a progressive mesh
  ModelSource source{};
  std::optional<LostEdits> lost{};         ///< to be repeated
  std::shared_ptr<const Mesh> stand_in{};  ///< as Document::stand_in
};

/// Reads a model, or a progressive mesh (see is_pm_file) at full detail. Does not compute the
/// statistics. Throws as read_model and read_pm_file.
LoadedModel open_model(const std::filesystem::path& file, const io::ReadOptions& options);

/// How a model is opened.
struct LoadOptions {
  io::ReadOptions read;
  /// Edges whose face normals differ by more than this become creases.
  std::optional<float> tag_creases_deg;
};

/// Does what a LoadJob does, on this thread. Throws as open_model; Cancelled.
LoadedModel load_model(const std::filesystem::path& file, LoadOptions options, Progress& progress);

/// Reads a model in the background. `take` throws what the reader throws (InputError).
class LoadJob : public JobOf<LoadedModel> {
 public:
  LoadJob(const std::filesystem::path& file, const LoadOptions& options, void (*wake)());
  /// Reads the model of lost edits as it was read before.
  LoadJob(LostEdits&& lost, void (*wake)());

  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace mesher::app
