#include "engine/core/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <limits>
#include <sstream>

#include "engine/core/error.h"
#include "engine/core/text.h"

namespace mesher {
namespace {

constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();

std::uint64_t system_available() {
  std::ifstream file("/proc/meminfo");
  std::string label;
  std::uint64_t kilobytes = 0;
  std::string unit;
  while (file >> label >> kilobytes) {
    if (label == "MemAvailable:") return kilobytes * 1024;
    std::getline(file, unit);
  }
  return kUnknown;
}

/// Returns the number at the beginning of a file, or kUnknown (no limit) for "max" or anything
/// else.
std::uint64_t number_in(const std::string& path) {
  std::ifstream file(path);
  std::uint64_t value = 0;
  return file >> value ? value : kUnknown;
}

/// Returns the number after `name` in a file with one "name number" pair per line, or 0 without it.
std::uint64_t named_number_in(const std::string& path, const std::string& name) {
  std::ifstream file(path);
  std::string label;
  std::uint64_t value = 0;
  while (file >> label >> value) {
    if (label == name) return value;
  }
  return 0;
}

/// The file names that one version of control groups uses.
struct GroupFiles {
  const char* root;
  const char* limit;
  const char* used;
  const char* cached;  ///< the part of the use that is file cache, which the kernel can evict
};

std::uint64_t group_available(const std::string& folder, const GroupFiles& files) {
  const std::uint64_t limit = number_in(folder + "/" + files.limit);
  const std::uint64_t used = number_in(folder + "/" + files.used);
  if (limit == kUnknown || used == kUnknown) return kUnknown;
  const std::uint64_t cached = named_number_in(folder + "/memory.stat", files.cached);
  const std::uint64_t held = used > cached ? used - cached : 0;
  return limit > held ? limit - held : 0;
}

/// Returns the least over the process's own group and the groups that contain it.
std::uint64_t groups_available(const std::string& path, const GroupFiles& files) {
  std::uint64_t least = kUnknown;
  for (const std::string& group : with_parents(path))
    least = std::min(least, group_available(files.root + group, files));
  return least;
}

/// Returns the rest of the limit that a shell's `ulimit -v` sets.
std::uint64_t address_space_available() {
  rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnknown;
  const std::uint64_t pages = number_in("/proc/self/statm");
  if (pages == kUnknown) return kUnknown;
  const std::uint64_t mapped = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return limit.rlim_cur > mapped ? limit.rlim_cur - mapped : 0;
}

bool has_memory(const std::string& controllers) {
  return ("," + controllers + ",").find(",memory,") != std::string::npos;
}

/// The state of the MemoryLimit. What was allocated before it began may be freed under it, so less
/// than nothing may be taken.
struct Account {
  std::atomic<std::uint64_t> limit{kUnknown};  ///< kUnknown without a limit
  std::atomic<std::int64_t> taken{0};
  std::atomic<std::int64_t> peak{0};
  std::atomic<std::uint64_t> refused{0};  ///< bytes of the last refusal
  std::atomic<std::int64_t> taken_then{0};
  std::atomic<bool> is_of_everything{false};
};
constinit Account account;

std::uint64_t left_of(std::uint64_t limit, std::int64_t taken) {
  if (taken <= 0) return limit;
  return limit - std::min(limit, static_cast<std::uint64_t>(taken));
}

/// Counts bytes unless that would exceed the limit by more than `room`.
bool take_within(std::uint64_t bytes, std::uint64_t room) noexcept {
  const std::uint64_t limit = account.limit.load(std::memory_order_relaxed);
  if (limit == kUnknown) return true;
  std::int64_t taken = account.taken.load(std::memory_order_relaxed);
  do {
    if (bytes > left_of(limit < kUnknown - room ? limit + room : limit, taken)) {
      account.refused = bytes;
      account.taken_then = taken;
      return false;
    }
  } while (!account.taken.compare_exchange_weak(taken, taken + static_cast<std::int64_t>(bytes),
                                                std::memory_order_relaxed));
  const std::int64_t now = taken + static_cast<std::int64_t>(bytes);
  std::int64_t peak = account.peak.load(std::memory_order_relaxed);
  while (peak < now && !account.peak.compare_exchange_weak(peak, now, std::memory_order_relaxed)) {
  }
  return true;
}

}  // namespace

MemoryLimit::MemoryLimit(std::uint64_t bytes, Of what) {
  account.taken = 0;
  account.peak = 0;
  account.refused = 0;
  account.limit = bytes;
  account.is_of_everything = what == Of::everything;
}

MemoryLimit::~MemoryLimit() {
  account.is_of_everything = false;
  account.limit = kUnknown;
}

bool MemoryLimit::take(std::uint64_t bytes) noexcept {
  return take_within(bytes, 0);
}

bool MemoryLimit::take_block(std::uint64_t bytes) noexcept {
  constexpr std::uint64_t kSmallBlock = std::uint64_t{64} << 10U;
  return take_within(bytes, bytes < kSmallBlock ? kRoomForSmallBlocks : 0);
}

void MemoryLimit::give_back(std::uint64_t bytes) noexcept {
  if (account.limit.load(std::memory_order_relaxed) == kUnknown) return;
  account.taken.fetch_sub(static_cast<std::int64_t>(bytes), std::memory_order_relaxed);
}

void MemoryLimit::correct(std::uint64_t taken, std::uint64_t allocated) noexcept {
  account.taken.fetch_add(static_cast<std::int64_t>(allocated) - static_cast<std::int64_t>(taken),
                          std::memory_order_relaxed);
}

std::uint64_t MemoryLimit::left() noexcept {
  const std::uint64_t limit = account.limit.load(std::memory_order_relaxed);
  return limit == kUnknown ? kUnknown : left_of(limit, account.taken);
}

std::uint64_t MemoryLimit::peak() noexcept {
  return static_cast<std::uint64_t>(account.peak.load());
}

bool MemoryLimit::counts_everything() noexcept {
  return account.is_of_everything.load(std::memory_order_relaxed);
}

std::string MemoryLimit::refusal() {
  if (!counts_everything() || account.refused == 0) return "";
  const auto taken = static_cast<std::uint64_t>(std::max<std::int64_t>(account.taken_then, 0));
  return fmt::format("--max-memory is {}, of which {} are in use; {} more are needed",
                     bytes_text(account.limit), bytes_text(taken), bytes_text(account.refused));
}

void throw_out_of_memory(const std::string& subject) {
  const std::string start = subject.empty() ? "" : subject + ": ";
  const std::string refusal = MemoryLimit::refusal();
  if (!refusal.empty()) throw LimitError(start + refusal);
  throw DeviceError(start + "out of memory");
}

// A line is "number:controllers:path". The only line of version 2 has no controllers.
GroupPaths parse_group_paths(const std::string& text) {
  GroupPaths paths;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string path = line.substr(second + 1);
    if (controllers.empty()) paths.v2 = path;
    if (has_memory(controllers)) paths.v1 = path;
  }
  return paths;
}

std::vector<std::string> with_parents(std::string path) {
  std::vector<std::string> paths;
  while (!path.empty()) {
    if (path.back() != '/') paths.push_back(path);
    path.erase(path.find_last_of('/') == std::string::npos ? 0 : path.find_last_of('/'));
  }
  paths.emplace_back();
  return paths;
}

std::uint64_t available_memory_bytes() {
  std::stringstream groups;
  groups << std::ifstream("/proc/self/cgroup").rdbuf();
  const GroupPaths paths = parse_group_paths(groups.str());
  return std::min({system_available(), address_space_available(), MemoryLimit::left(),
                   groups_available(paths.v2, {"/sys/fs/cgroup", "memory.max", "memory.current",
                                               "inactive_file"}),
                   groups_available(paths.v1, {"/sys/fs/cgroup/memory", "memory.limit_in_bytes",
                                               "memory.usage_in_bytes", "total_inactive_file"})});
}

}  // namespace mesher
