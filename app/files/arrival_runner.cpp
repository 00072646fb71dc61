#include "app/files/arrival_runner.h"

#include <utility>

#include "app/edit/progressive_edits.h"
#include "app/files/open.h"

namespace mesher::app {

void ArrivalRunner::take_over(std::unique_ptr<PmArrival> arrival) {
  arrival_ = std::move(arrival);
  if (arrival_) arrival_->set_wake(wake_);
}

void ArrivalRunner::open(const std::filesystem::path& file) {
  auto next = std::make_unique<PmArrival>(file);
  stop();
  take_over(std::move(next));
}

bool ArrivalRunner::is_busy() const {
  std::error_code ignored;
  return arrival_ && std::filesystem::is_regular_file(arrival_->file(), ignored);
}

/// The base would hide the model whose edit is running.
bool ArrivalRunner::must_wait() const {
  return !arrival_->has_base() && edits_.is_running();
}

bool ArrivalRunner::has_news() const {
  return arrival_ && !must_wait() &&
         (arrival_->is_done() || arrival_->has_news(session_.document.progressive));
}

bool ArrivalRunner::advance(double seconds) {
  if (!has_news()) return false;
  const bool had_base = arrival_->has_base();
  bool is_new = true;
  try {
    is_new = arrival_->advance(session_, seconds);
    if (!had_base && arrival_->has_base()) note_opened(session_, arrival_->file());
    if (arrival_->is_done()) arrival_.reset();
  } catch (const std::exception& error) {
    if (arrival_->has_base()) {
      session_.document.error = error.what();
    } else {
      note_not_opened(session_, {error.what()});
    }
    stop();
  }
  return is_new;
}

void ArrivalRunner::finish() {
  if (!arrival_) return;
  arrival_->finish(session_);
  arrival_.reset();
}

void ArrivalRunner::stop() {
  if (!arrival_) return;
  try {
    if (arrival_->has_base() && !arrival_->is_done()) arrival_->stop(session_.document);
  } catch (const std::exception& error) {
    // Out of memory: the loaded levels are dropped, and the base stays.
    forget_progressive(session_.document);
    session_.document.error = error.what();
  }
  arrival_.reset();
}

}  // namespace mesher::app
