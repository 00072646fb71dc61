#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "engine/io/read.h"
#include "engine/mesh/model.h"

namespace mesher::test {

/// Ends the program with a message about the current work if it takes too long. Otherwise a test
/// that hangs would not report why.
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

/// Reads a file as the program does and checks what must hold for any bytes: either a mesh with all
/// invariants, or an error of one line that names the file. Returns the model, or nothing if the
/// file was rejected. Fails the current test in any other case.
std::optional<Model> read_or_refuse(const std::filesystem::path& file,
                                    std::string* refusal = nullptr,
                                    const io::ReadOptions& options = {});

/// Reads a glTF file as the window does, makes what its scene shows, and writes it again with a
/// vertex moved: the results must be valid, or the file must be refused as above.
void edit_scene_or_refuse(const std::filesystem::path& file);

/// Rewrites a glTF file with each mesh replaced by two levels, and reads the result: it must be
/// readable, or the file must be refused as above.
void rewrite_or_refuse(const std::filesystem::path& file);

}  // namespace mesher::test
