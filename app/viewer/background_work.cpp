#include "app/viewer/background_work.h"

#include <utility>

#include "app/files/leave.h"
#include "app/files/restore.h"
#include "app/files/save.h"
#include "engine/core/error.h"
#include "engine/io/pm_file.h"

namespace mesher::app {
namespace {

// Time per frame for reading a progressive mesh that is loading.
constexpr double kArrivalSeconds = 0.008;

}  // namespace

BackgroundWork::BackgroundWork(Session& session, const io::ReadOptions& read,
                               std::function<void(LoadedModel&&)> show, void (*wake)())
    : session_(session),
      read_(read),
      show_(std::move(show)),
      wake_(wake),
      edits_(session.document, wake),
      arrivals_(session, edits_, wake) {}

void BackgroundWork::open(const std::filesystem::path& file) {
  session_.shows_open_dialog = false;
  session_.saving.shows_dialog = false;
  session_.document.error.clear();
  if (io::is_pm_file(file)) {
    if (arrivals_.open(file)) load_.reset();
    return;
  }
  load_ = std::make_unique<LoadJob>(file, read_, wake_);
}

void BackgroundWork::restore(LostEdits&& lost) {
  session_.document.error.clear();
  if (!io::is_pm_file(lost.file)) {
    load_ = std::make_unique<LoadJob>(std::move(lost), wake_);
    return;
  }
  // Its first edit may need the progressive mesh, so it has to be complete.
  if (!arrivals_.open(lost.file)) return;
  load_.reset();
  arrivals_.finish();
  request_lost_edits(session_.document, lost);
}

bool BackgroundWork::advance() {
  bool is_changed = finish_load();
  is_changed |= arrivals_.advance(kArrivalSeconds);
  is_changed |= edits_.advance();
  is_changed |= advance_save();
  return is_changed;
}

void BackgroundWork::stop() {
  arrivals_.stop();
  edits_.stop();
}

bool BackgroundWork::cancel() {
  if (load_) {
    load_->cancel();
  } else if (edits_.is_running()) {
    edits_.cancel();
  } else if (arrivals_.is_running()) {
    arrivals_.stop();
  } else {
    return false;
  }
  return true;
}

const Job* BackgroundWork::visible_job() const {
  if (load_) return load_.get();
  return edits_.is_running() ? edits_.job() : save_.get();
}

bool BackgroundWork::finish_load() {
  if (!load_ || !load_->is_done()) return false;
  const std::unique_ptr<LoadJob> job = std::move(load_);
  try {
    show_(job->take());
  } catch (const Cancelled&) {
    session_.document.notice = "canceled: " + job->file().string();
  } catch (const std::exception& error) {
    session_.document.error = error.what();
  }
  return true;
}

bool BackgroundWork::advance_save() {
  bool is_changed = false;
  try {
    if (save_ && save_->is_done()) {
      const std::unique_ptr<JobOf<Saved>> job = std::move(save_);
      is_changed = true;
      note_saved(session_, job->take());
    }
    if (!save_) start_save();
  } catch (const std::exception& error) {
    session_.document.error = error.what();
  }
  return is_changed;
}

void BackgroundWork::start_save() {
  const auto task = begin_save(session_.saving, session_.document);
  if (!task) return;
  save_ = std::make_unique<JobOf<Saved>>(
      "Saving " + task->file.filename().string(),
      [task = *task](Progress&) { return perform(task); }, wake_);
}

void BackgroundWork::finish_saves() {
  while (save_ || session_.saving.waiting) {
    if (!save_) start_save();
    save_->wait();
    const std::unique_ptr<JobOf<Saved>> job = std::move(save_);
    job->take();
  }
}

}  // namespace mesher::app
