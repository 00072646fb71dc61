#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/document/session.h"
#include "app/edit/edit_runner.h"
#include "app/files/arrival_runner.h"
#include "app/files/load_job.h"
#include "app/files/save.h"
#include "engine/core/canceled_jobs.h"

namespace mesher::app {

/// The device that pictures are drawn on, besides the window's.
struct PictureDevice {
  std::string select;       ///< as gpu::DeviceOptions::select
  bool validation = false;  ///< messages of the validation layer are errors
};

/// The work that a window does while it stays responsive: edits, loading models and progressive
/// meshes, saving. Failures become the session's error.
class BackgroundWork {
 public:
  /// `show` receives a model that has been loaded. `wake` as for Job.
  /// `gpu`: on which pictures are drawn.
  BackgroundWork(Session& session, const io::ReadOptions& read, const PictureDevice& gpu,
                 std::function<void(LoadedModel&&)> show, void (*wake)());

  /// Queues files, which are opened one after another, each in a tab. The shown model stays until
  /// the next one is read, its edits are done, and its own file is loaded.
  void open(const std::vector<std::filesystem::path>& files);
  /// Continues to read a model that was begun before there was a window; may be null.
  void take_over(std::unique_ptr<LoadJob> load) { load_ = std::move(load); }
  /// Queues the model of lost edits, and then requests the edits.
  void restore(LostEdits&& lost);
  /// Continues with a progressive mesh that was opened before there was a window; may be null.
  void take_over(std::unique_ptr<PmArrival> arrival) { arrivals_.take_over(std::move(arrival)); }

  /// Takes finished work into the session and starts what comes next. Returns whether anything has
  /// changed that a person can see.
  bool advance();
  void stop_edits() { edits_.stop(); }
  void stop_arrival() { arrivals_.stop(); }
  /// Cancels the innermost job, and says so at once. Returns whether there was one. A file that is
  /// just getting its name is written nevertheless.
  bool cancel();
  /// Returns when no edit is running or requested.
  void finish_edits() { edits_.finish(); }
  /// Returns when a progressive mesh that is loading is complete. Throws InputError.
  void finish_arrival() { arrivals_.finish(); }
  /// Returns when all requested files are saved. Throws OutputError, because no window is left to
  /// show the error.
  void finish_saves();
  /// Returns whether a model or a picture is being written, or is requested.
  bool is_writing() const;
  /// Returns whether a file was not written since the last call, because that failed or was
  /// canceled.
  bool take_write_failure() { return std::exchange(has_write_failure_, false); }

  /// The job whose progress is shown; null: none.
  const Job* visible_job() const;
  bool can_cancel() const { return visible_job() != nullptr; }
  /// Returns whether `advance` has something to do at once.
  bool has_news() const { return arrivals_.has_news() || has_loaded(); }
  bool is_arriving() const { return arrivals_.is_running(); }

 private:
  /// A file to open.
  struct Opening {
    std::filesystem::path file;
    std::optional<LostEdits> lost;  ///< to be repeated
  };

  bool can_show_next() const;
  bool has_loaded() const { return load_ && load_->is_done() && can_show_next(); }
  void start_opening();
  void start(Opening&& opening);
  void cancel_load();
  void note_write_canceled(const char* notice);
  bool finish_load();
  void report_failures();
  bool advance_save();
  bool advance_picture();
  void start_picture();
  void start_save();

  Session& session_;
  io::ReadOptions read_;
  PictureDevice gpu_;
  std::function<void(LoadedModel&&)> show_;
  void (*wake_)();
  EditRunner edits_;
  ArrivalRunner arrivals_;
  std::deque<Opening> queue_;
  std::vector<std::string> failures_;  ///< of the files of the queue
  CanceledJobs canceled_;
  std::unique_ptr<LoadJob> load_;
  std::unique_ptr<JobOf<Saved>> save_;
  std::unique_ptr<JobOf<std::filesystem::path>> picture_;
  bool has_write_failure_ = false;
};

}  // namespace mesher::app
