#include "app/files/desktop_dialog.h"

#include <utility>

#include "app/files/file_portal.h"
#include "app/files/glib_handle.h"
#include "app/files/session_bus.h"
#include "engine/core/assert.h"

namespace mesher::app {
namespace {

// Answers arrive within a few milliseconds if the portal is running.
constexpr std::chrono::milliseconds kProbePatience{200};

std::shared_ptr<GCancellable> new_cancellable() {
  return {g_cancellable_new(), GlibRelease{}};
}

}  // namespace

DesktopDialog::DesktopDialog(void (*wake)())
    : address_(session_bus_address()),
      wake_(wake),
      answer_by_(std::chrono::steady_clock::now() + kProbePatience),
      stop_probe_(new_cancellable()) {
  if (address_.empty()) return;
  probe_ = std::async(std::launch::async, [address = address_, stop = stop_probe_] {
    return has_file_portal(address, stop.get());
  });
}

DesktopDialog::~DesktopDialog() {
  g_cancellable_cancel(stop_probe_.get());
  close();
}

bool DesktopDialog::is_available() {
  if (!probe_.valid() || has_failed_) return false;
  return probe_.wait_until(answer_by_) == std::future_status::ready && probe_.get();
}

void DesktopDialog::open(FileDialog dialog, bool allows_several) {
  ask({.dialog = std::move(dialog), .allows_several = allows_several});
}

void DesktopDialog::save(FileDialog dialog, std::string suggested_name) {
  ask({.dialog = std::move(dialog), .saves = true, .suggested_name = std::move(suggested_name)});
}

void DesktopDialog::ask(PortalQuestion question) {
  MESHER_ASSERT(!is_open());
  stop_ = new_cancellable();
  const std::string title = question.dialog.title;
  asking_ = std::make_unique<JobOf<DialogAnswer>>(
      title,
      [address = address_, question = std::move(question), stop = stop_](Progress&) {
        return ask_file_portal(address, question, stop.get());
      },
      wake_);
}

std::optional<DialogAnswer> DesktopDialog::take() {
  if (!asking_ || !asking_->is_done()) return std::nullopt;
  const std::unique_ptr<JobOf<DialogAnswer>> job = std::move(asking_);
  DialogAnswer answer;
  try {
    answer = job->take();
  } catch (const std::exception& error) {
    answer = {.outcome = DialogOutcome::failed, .problem = error.what()};
  }
  has_failed_ |= answer.outcome == DialogOutcome::failed;
  return answer;
}

void DesktopDialog::close() {
  if (stop_) g_cancellable_cancel(stop_.get());
  asking_.reset();
}

}  // namespace mesher::app
