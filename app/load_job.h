#pragma once

#include <atomic>
#include <exception>
#include <filesystem>
#include <optional>
#include <thread>

#include "engine/core/progress.h"
#include "engine/io/read.h"
#include "engine/mesh/statistics.h"

namespace mesher::app {

/// A model with what was computed about it on the way.
struct LoadedModel {
  Model model;
  Statistics statistics;
  std::filesystem::path file;
};

/// Reads a model on a thread of its own. Destroying it cancels and waits.
class LoadJob {
 public:
  /// `wake` is called from the thread when there is a result to fetch; it must be safe there.
  LoadJob(std::filesystem::path file, ReadOptions options, void (*wake)());
  ~LoadJob();
  LoadJob(const LoadJob&) = delete;
  LoadJob& operator=(const LoadJob&) = delete;

  const std::filesystem::path& file() const { return file_; }
  const Progress& progress() const { return progress_; }
  void cancel() { progress_.cancel(); }
  bool is_done() const { return is_done_.load(std::memory_order_acquire); }
  /// The model; throws what the reader threw (InputError, Cancelled). Pre: is_done(), called once.
  LoadedModel take();

 private:
  void run(ReadOptions options, void (*wake)());

  std::filesystem::path file_;
  Progress progress_;
  std::optional<LoadedModel> result_;
  std::exception_ptr failure_;
  std::atomic<bool> is_done_{false};
  std::thread thread_;
};

}  // namespace mesher::app
