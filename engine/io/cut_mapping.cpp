#include "engine/io/cut_mapping.h"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>

namespace mesher::io {

/// A watched mapping. A signal handler reads it, so that its parts are atomic.
struct Slot {
  std::atomic<bool> is_taken{false};
  std::atomic<std::uintptr_t> begin{0};
  std::atomic<std::uintptr_t> end{0};  ///< 0: not yet, or no longer, watched
  std::atomic<bool> is_cut{false};
};

namespace {

/// More files than one model has buffers and textures.
std::array<Slot, 1024> slots;
std::atomic<bool> is_surviving{false};

/// Puts zeros in place of the rest of a mapping, from the page that could not be read. Returns
/// false if the address is in none that is watched. Calls only what a signal handler may call.
bool put_zeros(std::uintptr_t address) {
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  for (Slot& slot : slots) {
    const std::uintptr_t end = slot.end.load();
    if (address >= end || address < slot.begin.load()) continue;
    if (slot.end.load() != end) continue;  // it has become another one's just now
    const std::uintptr_t from = address / page * page;
    slot.is_cut.store(true);
    return ::mmap(reinterpret_cast<void*>(from), end - from, PROT_READ,
                  MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) != MAP_FAILED;
  }
  return false;
}

extern "C" void on_bus_error(int signal, siginfo_t* info, void*) {
  const int error = errno;
  const bool is_of_kernel = info->si_code > 0;  // and not sent by a process, without an address
  if (!is_of_kernel || !put_zeros(reinterpret_cast<std::uintptr_t>(info->si_addr)))
    std::signal(signal, SIG_DFL);  // the instruction runs again, and ends the process as usual
  errno = error;
}

}  // namespace

bool survives_cut_mappings() {
  return is_surviving.load();
}

void survive_cut_mappings() {
  struct sigaction action = {};
  action.sa_sigaction = on_bus_error;
  action.sa_flags = SA_SIGINFO;
  is_surviving = ::sigaction(SIGBUS, &action, nullptr) == 0;
}

bool CutWatch::start(const void* begin, std::size_t bytes) noexcept {
  for (Slot& slot : slots) {
    if (slot.is_taken.exchange(true)) continue;
    slot.is_cut.store(false);
    slot.begin.store(reinterpret_cast<std::uintptr_t>(begin));
    slot.end.store(reinterpret_cast<std::uintptr_t>(begin) + bytes);
    slot_ = &slot;
    return true;
  }
  return false;
}

void CutWatch::stop() noexcept {
  if (slot_ == nullptr) return;
  slot_->end.store(0);
  slot_->is_taken.store(false);
  slot_ = nullptr;
}

bool CutWatch::is_cut() const noexcept {
  return slot_ != nullptr && slot_->is_cut.load();
}

}  // namespace mesher::io
