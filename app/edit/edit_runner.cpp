#include "app/edit/edit_runner.h"

#include <new>
#include <utility>

#include "app/edit/edits.h"
#include "app/edit/subdivide_edit.h"
#include "engine/core/error.h"

namespace mesher::app {
namespace {

constexpr const char* kNoMemory = "out of memory: the model cannot be copied";

}  // namespace

bool EditRunner::advance() {
  canceled_.reap();
  bool has_changed = drop_foreign_job();
  has_changed |= std::exchange(was_canceled_, false);
  if (job_ && job_->is_done()) {
    take();
    has_changed = true;
  }
  while (!job_ && !document_.edits.waiting.empty()) {
    start();
    has_changed = true;
  }
  return has_changed;
}

/// Drops the job if its model was replaced or another one is shown.
bool EditRunner::drop_foreign_job() {
  if (!job_ || job_of_ == document_.opening) return false;
  document_.notice = "canceled: " + job_->title();
  canceled_.take(job_);
  return true;
}

void EditRunner::start() {
  try {
    const std::shared_ptr<EditTask> task = start_next_edit(document_);
    if (!task) return;
    document_.edits.is_changing = task->changes_model();
    job_of_ = document_.opening;
    job_ = std::make_unique<EditJob>(
        task->title(),
        [task](Progress& progress) {
          task->perform(&progress);
          return task;
        },
        wake_);
  } catch (const std::bad_alloc&) {
    document_.edits.waiting.clear();
    document_.error = kNoMemory;
    follow_shown_level(document_.edits, document_.subdivide);
  } catch (const Error& error) {
    document_.edits.waiting.clear();
    document_.error = error.what();
    follow_shown_level(document_.edits, document_.subdivide);
  }
}

void EditRunner::take() {
  const std::unique_ptr<EditJob> job = std::move(job_);
  document_.edits.is_changing = false;
  try {
    job->take()->finish(document_);
  } catch (const std::bad_alloc&) {
    document_.edits.waiting.clear();
    document_.error = kNoMemory;
  } catch (const std::exception& error) {
    document_.edits.waiting.clear();
    document_.error = error.what();
  }
  follow_shown_level(document_.edits, document_.subdivide);
}

void EditRunner::cancel() {
  document_.edits.waiting.clear();
  if (!job_) return;
  canceled_.take(job_);  // edits are never sealed: their result is taken here
  was_canceled_ = true;
  document_.edits.is_changing = false;
  document_.notice = "canceled";
  follow_shown_level(document_.edits, document_.subdivide);
}

void EditRunner::stop() {
  document_.edits.waiting.clear();
  document_.edits.is_changing = false;
  job_.reset();
}

void EditRunner::finish() {
  do {
    if (job_) job_->wait();
    advance();
  } while (job_);
}

}  // namespace mesher::app
