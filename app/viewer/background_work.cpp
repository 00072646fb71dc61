#include "app/viewer/background_work.h"

#include <utility>

#include "app/files/leave.h"
#include "app/files/open.h"
#include "app/files/picture_requests.h"
#include "app/files/restore.h"
#include "app/files/save.h"
#include "app/viewer/graphics.h"
#include "engine/core/error.h"
#include "engine/io/pm_file.h"

namespace mesher::app {
namespace {

// Time per frame for reading a progressive mesh that is loading.
constexpr double kArrivalSeconds = 0.008;

}  // namespace

BackgroundWork::BackgroundWork(Session& session, const io::ReadOptions& read,
                               const PictureDevice& gpu, std::function<void(LoadedModel&&)> show,
                               void (*wake)())
    : session_(session),
      read_(read),
      gpu_(gpu),
      show_(std::move(show)),
      wake_(wake),
      edits_(session.document, wake),
      arrivals_(session, edits_, wake) {}

void BackgroundWork::open(const std::vector<std::filesystem::path>& files) {
  session_.document.error.clear();
  for (const std::filesystem::path& file : files)
    queue_.push_back({file, std::nullopt});
}

void BackgroundWork::restore(LostEdits&& lost) {
  session_.document.error.clear();
  const std::filesystem::path file = lost.file;
  queue_.push_back({file, std::move(lost)});
}

bool BackgroundWork::advance() {
  canceled_.reap();
  bool is_changed = finish_load();
  is_changed |= arrivals_.advance(kArrivalSeconds);
  is_changed |= edits_.advance();
  is_changed |= advance_save();
  is_changed |= advance_picture();
  start_opening();
  return is_changed;
}

/// An edit belongs to the shown document, and so does a file that is loading. Only a pipe may never
/// end: the part that has arrived stays in its tab.
bool BackgroundWork::can_show_next() const {
  return !edits_.is_running() && !arrivals_.is_busy();
}

void BackgroundWork::start_opening() {
  if (load_ || queue_.empty() || !can_show_next()) return;
  Opening next = std::move(queue_.front());
  queue_.pop_front();
  try {
    start(std::move(next));
  } catch (const std::exception& error) {
    failures_.emplace_back(error.what());
  }
  report_failures();
}

void BackgroundWork::start(Opening&& opening) {
  if (!io::is_pm_file(opening.file)) {
    load_ = opening.lost
                ? std::make_unique<LoadJob>(std::move(*opening.lost), wake_)
                : std::make_unique<LoadJob>(opening.file, LoadOptions{read_, std::nullopt}, wake_);
    return;
  }
  arrivals_.open(opening.file);
  if (!opening.lost) return;
  // Its first edit may need the progressive mesh, so it has to be complete.
  arrivals_.finish();
  request_lost_edits(session_.document, *opening.lost);
}

void BackgroundWork::report_failures() {
  if (!load_ && queue_.empty() && !failures_.empty())
    note_not_opened(session_, std::exchange(failures_, {}));
}

bool BackgroundWork::cancel() {
  if (load_) {
    cancel_load();
  } else if (edits_.is_running()) {
    edits_.cancel();
  } else if (arrivals_.is_running()) {
    arrivals_.stop();
  } else if (save_) {
    if (canceled_.take(save_)) note_write_canceled("canceled; nothing was written");
  } else if (picture_) {
    if (canceled_.take(picture_)) note_write_canceled("canceled; no picture was written");
  } else {
    return false;
  }
  return true;
}

void BackgroundWork::note_write_canceled(const char* notice) {
  has_write_failure_ = true;
  session_.document.notice = notice;
}

void BackgroundWork::cancel_load() {
  queue_.clear();
  const std::filesystem::path file = load_->file();
  if (!canceled_.take(load_)) return;
  note_canceled(session_, file);
  report_failures();
}

const Job* BackgroundWork::visible_job() const {
  if (load_ && !load_->is_done()) return load_.get();
  if (edits_.is_running()) return edits_.job();
  return save_ ? static_cast<const Job*>(save_.get()) : picture_.get();
}

bool BackgroundWork::finish_load() {
  if (!has_loaded()) return false;
  const std::unique_ptr<LoadJob> job = std::move(load_);
  try {
    arrivals_.stop();
    show_(job->take());
    note_opened(session_, job->file());
  } catch (const GraphicsFailed&) {
    throw;  // the model is not the reason
  } catch (const std::exception& error) {
    failures_.emplace_back(error.what());
  }
  report_failures();
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
    has_write_failure_ = true;
    session_.document.error = error.what();
  }
  return is_changed;
}

void BackgroundWork::start_save() {
  const auto task = begin_save(session_.saving, session_.document);
  if (!task) return;
  save_ = std::make_unique<JobOf<Saved>>(
      "Saving " + task->file.filename().string(),
      [task = *task](Progress& progress) { return perform(task, &progress); }, wake_);
}

bool BackgroundWork::advance_picture() {
  bool is_changed = false;
  try {
    if (picture_ && picture_->is_done()) {
      const std::unique_ptr<JobOf<std::filesystem::path>> job = std::move(picture_);
      is_changed = true;
      session_.document.notice = "saved " + job->take().string();
    }
    if (!picture_) start_picture();
  } catch (const std::exception& error) {
    has_write_failure_ = true;
    session_.document.error = error.what();
  }
  return is_changed;
}

void BackgroundWork::start_picture() {
  std::optional<PictureTask> task = begin_requested_picture(session_);
  if (!task) return;
  task->device = gpu_.select;
  task->validation = gpu_.validation;
  const std::string title = "Drawing " + task->request.file.filename().string();
  picture_ = std::make_unique<JobOf<std::filesystem::path>>(
      title,
      [task = std::make_shared<PictureTask>(std::move(*task))](Progress& progress) {
        perform(*task, &progress);
        return task->request.file;
      },
      wake_);
}

bool BackgroundWork::is_writing() const {
  return save_ || picture_ || session_.saving.waiting || session_.picture.waiting;
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
