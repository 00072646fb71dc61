#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "app/document/session.h"
#include "app/edit/edit_runner.h"
#include "app/files/arrival_runner.h"
#include "app/files/load_job.h"
#include "app/files/save.h"

namespace mesher::app {

/// The work that a window does while it stays responsive: edits, loading models and progressive
/// meshes, saving. Failures become the session's error.
class BackgroundWork {
 public:
  /// `show` receives a model that has been loaded. `wake` as for Job.
  BackgroundWork(Session& session, const io::ReadOptions& read,
                 std::function<void(LoadedModel&&)> show, void (*wake)());

  /// Begins to load a file; the shown model stays until the file is read.
  void open(const std::filesystem::path& file);
  /// Reads the model of lost edits, and requests the edits.
  void restore(LostEdits&& lost);
  /// Continues with a progressive mesh that was opened before there was a window; may be null.
  void take_over(std::unique_ptr<PmArrival> arrival) { arrivals_.take_over(std::move(arrival)); }

  /// Takes finished work into the session and starts what comes next. Returns whether anything has
  /// changed that a person can see.
  bool advance();
  /// Stops the work on the shown model, without a notice. Returns when it has ended.
  void stop();
  void stop_edits() { edits_.stop(); }
  void stop_arrival() { arrivals_.stop(); }
  /// Cancels the innermost job. Returns whether there was one.
  bool cancel();
  /// Returns when no edit is running or requested.
  void finish_edits() { edits_.finish(); }
  /// Returns when a progressive mesh that is loading is complete. Throws InputError.
  void finish_arrival() { arrivals_.finish(); }
  /// Returns when all requested files are written. Throws OutputError, because no window is left to
  /// show the error.
  void finish_saves();

  /// The job whose progress is shown; null: none.
  const Job* visible_job() const;
  bool can_cancel() const { return load_ != nullptr || edits_.is_running(); }
  /// Returns whether `advance` has something to do at once.
  bool has_news() const { return arrivals_.has_news(); }
  bool is_arriving() const { return arrivals_.is_running(); }

 private:
  bool finish_load();
  bool advance_save();
  void start_save();

  Session& session_;
  io::ReadOptions read_;
  std::function<void(LoadedModel&&)> show_;
  void (*wake_)();
  EditRunner edits_;
  ArrivalRunner arrivals_;
  std::unique_ptr<LoadJob> load_;
  std::unique_ptr<JobOf<Saved>> save_;
};

}  // namespace mesher::app
