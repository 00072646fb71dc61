#pragma once

#include <sys/types.h>

#include <functional>
#include <string_view>
#include <utility>

#include "engine/core/progress.h"
#include "engine/io/child_process.h"

namespace mesher::io {

/// An end of a pipe, which is closed at the latest when the object dies.
class PipeEnd {
 public:
  explicit PipeEnd(int number) : number_(number) {}
  ~PipeEnd() { close(); }
  PipeEnd(const PipeEnd&) = delete;
  PipeEnd& operator=(const PipeEnd&) = delete;
  int number() const { return number_; }
  void close();

 private:
  int number_;
};

/// A pipe from child processes to this one. Throws DeviceError if the system has none left.
class Pipe {
 public:
  Pipe() : Pipe(open()) {}

  /// Writes all bytes. For a child. Returns false if that fails.
  bool write(std::string_view bytes) const;
  /// Ends writing from this process. Call it after the children have started, so that read() sees
  /// their end.
  void close_output() { output_.close(); }
  /// Waits for bytes, and returns how many it has read, at most `most`: 0 once all children have
  /// ended. Throws Cancelled.
  std::size_t read(char* bytes, std::size_t most, const Progress* progress) const;

 private:
  static std::pair<int, int> open();
  explicit Pipe(std::pair<int, int> ends) : input_(ends.first), output_(ends.second) {}

  PipeEnd input_;
  PipeEnd output_;
};

/// A copy of this process that does some work and ends. It is killed if the object dies first.
class Child {
 public:
  /// Starts it. `work` returns whether it succeeded; if it throws, it did not. What it may do: see
  /// run_in_child. Throws DeviceError if the system starts no process.
  Child(const ChildLimits& limits, const std::function<bool()>& work);
  ~Child();
  Child(Child&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Child& operator=(Child&&) = delete;

  /// Waits for its end and returns the status of waitpid. Pre: not called before.
  int wait();

 private:
  pid_t id_;
};

/// Ends this process once it has used so many more seconds of CPU time. For a child.
void limit_cpu_time(unsigned seconds);

}  // namespace mesher::io
