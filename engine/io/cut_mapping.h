#pragma once

#include <atomic>
#include <cstddef>

namespace mesher::io {

/// Lets the process survive that another program cuts a mapped file short. By default the system
/// ends it by SIGBUS when it reads beyond the new end. Afterwards, a CutWatch notes this, and zeros
/// are read instead. Call once, in `main`: a library leaves the signals of its process alone.
void survive_cut_mappings();
/// Returns whether the process survives that.
bool survives_cut_mappings();

/// Notes when a mapping of a file loses its end. Has no effect without survive_cut_mappings.
class CutWatch {
 public:
  CutWatch() = default;
  ~CutWatch() { stop(); }
  CutWatch(const CutWatch&) = delete;
  CutWatch& operator=(const CutWatch&) = delete;

  /// Starts to watch a mapping; call stop before it is unmapped. Returns false if the process
  /// watches too many already.
  bool start(const void* begin, std::size_t bytes) noexcept;
  void stop() noexcept;
  /// Returns whether bytes were read that the file no longer has.
  bool is_cut() const noexcept;

 private:
  struct Slot* slot_ = nullptr;
};

}  // namespace mesher::io
