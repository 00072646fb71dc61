#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "engine/core/job.h"

namespace mesher {

/// Jobs that were canceled and have not ended yet. Their owner is rid of them at once, and neither
/// waits until they notice the cancellation nor until their memory is free. The destructor waits.
class CanceledJobs {
 public:
  /// Cancels a job and takes it. Returns false, and leaves the job, if its result is already being
  /// put in place (Progress::seal). Pre: there is a job.
  template <class J>
  bool take(std::unique_ptr<J>& job) {
    if (!job->cancel()) return false;
    jobs_.push_back(std::move(job));
    return true;
  }
  /// Destroys those that have ended.
  void reap() {
    std::erase_if(jobs_, [](const std::unique_ptr<Job>& job) { return job->is_done(); });
  }
  bool is_empty() const { return jobs_.empty(); }

 private:
  std::vector<std::unique_ptr<Job>> jobs_;
};

}  // namespace mesher
