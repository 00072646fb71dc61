#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "engine/mesh/model.h"

namespace mesher::test {

/// Ends the program, saying what it was at, where a piece of work takes too long: a test that hangs
/// would otherwise not say so.
class Watchdog {
 public:
  Watchdog(std::string what, std::chrono::seconds limit);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

 private:
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  std::thread thread_;
};

/// Reads a file as the program would and checks what must hold whatever its bytes are: a mesh with
/// all invariants, or a refusal of one line that names the file. Returns the model, or nothing
/// where it was refused. Fails the current test where neither happens.
std::optional<Model> read_or_refuse(const std::filesystem::path& file,
                                    std::string* refusal = nullptr);

}  // namespace mesher::test
