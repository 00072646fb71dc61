#include "app/edit_runner.h"

#include <new>
#include <utility>

#include "engine/core/error.h"

namespace mesher::app {
namespace {

constexpr const char* kNoMemory = "not enough memory for another copy of the model";

}  // namespace

bool EditRunner::advance() {
  bool has_changed = false;
  if (job_ && job_->is_done()) {
    take();
    has_changed = true;
  }
  while (!job_ && !session_.edits.waiting.empty()) {
    start();
    has_changed = true;
  }
  return has_changed;
}

void EditRunner::start() {
  try {
    auto task = begin_edit(session_);
    if (!task) return;
    const std::string title = task->title;
    job_ = std::make_unique<JobOf<EditResult>>(
        title, [task = std::move(*task)](Progress& progress) { return perform(task, &progress); },
        wake_);
  } catch (const std::bad_alloc&) {
    session_.edits.waiting.clear();
    session_.error = kNoMemory;
    follow_shown_level(session_);
  }
}

void EditRunner::take() {
  const std::unique_ptr<JobOf<EditResult>> job = std::move(job_);
  try {
    EditResult result = job->take();
    if (job->progress().is_cancelled()) throw Cancelled();  // too late to stop it
    finish_edit(session_, std::move(result));
  } catch (const Cancelled&) {
    session_.notice = "cancelled";
  } catch (const std::bad_alloc&) {
    session_.edits.waiting.clear();
    session_.error = kNoMemory;
  } catch (const std::exception& error) {
    session_.edits.waiting.clear();
    session_.error = error.what();
  }
  follow_shown_level(session_);
}

void EditRunner::cancel() {
  session_.edits.waiting.clear();
  if (job_) job_->cancel();
}

void EditRunner::stop() {
  session_.edits.waiting.clear();
  job_.reset();
}

void EditRunner::finish() {
  do {
    if (job_) job_->wait();
    advance();
  } while (job_);
}

}  // namespace mesher::app
