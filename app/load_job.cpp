#include "app/load_job.h"

#include <new>

#include "engine/core/assert.h"
#include "engine/core/error.h"

namespace mesher::app {

LoadJob::LoadJob(std::filesystem::path file, ReadOptions options, void (*wake)())
    : file_(std::move(file)), thread_([this, options, wake] { run(options, wake); }) {}

LoadJob::~LoadJob() {
  cancel();
  thread_.join();
}

void LoadJob::run(ReadOptions options, void (*wake)()) {
  try {
    options.progress = &progress_;
    LoadedModel loaded{read_model(file_, options), {}, file_};
    begin_stage(&progress_, "counting");
    loaded.statistics = statistics(loaded.model.mesh);
    result_ = std::move(loaded);
  } catch (const std::bad_alloc&) {
    failure_ = std::make_exception_ptr(
        Error(ExitCode::machine_lacks, file_.string() + ": not enough memory to open it"));
  } catch (...) {
    failure_ = std::current_exception();
  }
  is_done_.store(true, std::memory_order_release);
  wake();
}

LoadedModel LoadJob::take() {
  MESHER_ASSERT(is_done());
  if (failure_) std::rethrow_exception(failure_);
  return std::move(*result_);
}

}  // namespace mesher::app
