#include "tests/fuzz/support.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "engine/core/error.h"
#include "engine/io/read.h"
#include "engine/mesh/validate.h"

namespace mesher::test {

Watchdog::Watchdog(std::string what, std::chrono::seconds limit)
    : thread_([this, what = std::move(what), limit] {
        std::unique_lock lock(mutex_);
        if (done_.wait_for(lock, limit, [this] { return is_done_; })) return;
        std::fprintf(stderr, "still busy after %lld s: %s\n", static_cast<long long>(limit.count()),
                     what.c_str());
        std::abort();
      }) {}

Watchdog::~Watchdog() {
  {
    const std::lock_guard lock(mutex_);
    is_done_ = true;
  }
  done_.notify_all();
  thread_.join();
}

std::optional<Model> read_or_refuse(const std::filesystem::path& file, std::string* refusal) {
  try {
    Model model = io::read_model(file);
    for (const Violation& violation : validate(model.mesh)) {
      ADD_FAILURE() << "invariant " << violation.invariant << ": " << violation.what;
    }
    for (const Violation& violation : validate(model.mesh, model.attributes)) {
      ADD_FAILURE() << "invariant " << violation.invariant << ": " << violation.what;
    }
    return model;
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind(file.string(), 0), 0U) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_LT(message.size(), file.string().size() + 200) << message;
    if (refusal != nullptr) *refusal = message;
    return std::nullopt;
  }
}

}  // namespace mesher::test
