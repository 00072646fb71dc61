#include "engine/io/child_process.h"

#include <sys/wait.h>

#include <array>

#include "engine/io/child.h"

namespace mesher::io {
namespace {

/// Reads to the end. Returns false if there is more than `most`.
bool read_all(const Pipe& pipe, std::size_t most, Progress* progress, std::string& bytes) {
  std::array<char, std::size_t{1} << 16U> block;
  while (const std::size_t count = pipe.read(block.data(), block.size(), progress)) {
    if (bytes.size() + count > most) return false;
    bytes.append(block.data(), count);
  }
  return true;
}

}  // namespace

ChildResult run_in_child(const std::function<bool(const ChildWriter&)>& work,
                         const ChildLimits& limits, Progress* progress) {
  Pipe pipe;
  Child child(limits,
              [&] { return work([&pipe](std::string_view bytes) { return pipe.write(bytes); }); });
  pipe.close_output();
  ChildResult result;
  if (!read_all(pipe, limits.output, progress, result.bytes)) return {ChildOutcome::too_long, {}};
  const int status = child.wait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    result.outcome = ChildOutcome::done;
    return result;
  }
  return {WIFSIGNALED(status) ? ChildOutcome::died : ChildOutcome::refused, {}};
}

}  // namespace mesher::io
