#include "engine/io/mapped_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "engine/core/error.h"

namespace mesher::io {
namespace {

constexpr int kCancelCheckMs = 100;
constexpr std::size_t kReadBlock = std::size_t{1} << 20;

struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

// A named pipe reads as ended until a writer opens it; poll tells the difference.
void wait_for_data(int descriptor, Progress* progress) {
  pollfd readable{descriptor, POLLIN, 0};
  while (::poll(&readable, 1, kCancelCheckMs) == 0) {
    if (progress != nullptr && progress->is_cancelled()) throw Cancelled();
  }
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& file, Progress* progress, Keep keep)
    : name_(file.string()), keep_(survives_cut_mappings() ? keep : Keep::copied) {
  // Open without blocking: a pipe without a writer must not delay cancellation.
  const Descriptor in{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (in.fd < 0) fail("cannot open");
  struct stat status = {};
  if (::fstat(in.fd, &status) != 0) fail("cannot open");
  if (S_ISDIR(status.st_mode)) throw InputError(name_, 0, "is a directory");
  // Devices are refused because their data may never end. A terminal is a device too.
  if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)) throw InputError(name_, 0, "is a device");
  // Files under /proc report size 0 but are not empty, so they are read block by block.
  stamp_ = FileStamp(in.fd);
  const auto size = static_cast<std::size_t>(stamp_.size());
  if (S_ISREG(status.st_mode) && size > 0 && keep_ == Keep::mapped && map(in.fd, size)) return;
  // One byte more than a small file has, so that its end is found without another block.
  const std::size_t first = size > 0 ? std::min(size + 1, kReadBlock) : kReadBlock;
  read_blocks(in.fd, first, progress);
  check_unchanged();
  stamp_ = {};
}

MappedFile::MappedFile(std::string name, std::string_view bytes)
    : name_(std::move(name)), keep_(Keep::copied), size_(bytes.size()) {
  copy_.assign(size_ + kPadding, '\0');
  std::ranges::copy(bytes, copy_.begin());
  data_ = copy_.data();
}

MappedFile::~MappedFile() {
  watch_.stop();
  if (mapped_bytes_ != 0) ::munmap(const_cast<char*>(data_), mapped_bytes_);
}

/// Returns false if the mapping cannot be watched.
bool MappedFile::map(int descriptor, std::size_t size) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  // For the padding, map anonymous pages one page past the file's end, then map the file over them.
  // The kernel zeroes the rest of the file's last page.
  const std::size_t bytes = (size / page + 2) * page;
  void* const area = ::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (area == MAP_FAILED) fail("cannot map");
  if (::mmap(area, size, PROT_READ, MAP_PRIVATE | MAP_FIXED, descriptor, 0) == MAP_FAILED) {
    const int error = errno;
    ::munmap(area, bytes);
    errno = error;
    fail("cannot map");
  }
  if (!watch_.start(area, bytes)) {
    ::munmap(area, bytes);
    return false;
  }
  ::madvise(area, size, MADV_SEQUENTIAL);
  data_ = static_cast<const char*>(area);
  size_ = size;
  mapped_bytes_ = bytes;
  return true;
}

void MappedFile::read_blocks(int descriptor, std::size_t first, Progress* progress) {
  copy_.resize(first + kPadding);
  for (;;) {
    check_cancelled(progress);
    wait_for_data(descriptor, progress);
    if (size_ + kPadding >= copy_.size()) copy_.resize(2 * copy_.size() + kReadBlock);
    const std::size_t room = std::min(copy_.size() - kPadding - size_, kReadBlock);
    const ssize_t got = ::read(descriptor, copy_.data() + size_, room);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got < 0) fail("cannot read");
    if (got == 0) break;
    size_ += static_cast<std::size_t>(got);
  }
  copy_.resize(size_ + kPadding);
  std::memset(copy_.data() + size_, 0, kPadding);
  data_ = copy_.data();
}

void MappedFile::check_unchanged() const {
  if (watch_.is_cut()) {
    throw InputChanged(
        name_, 0, "could not be read to its end: it was cut short meanwhile, or its disk failed");
  }
  if (!stamp_.is_current(name_))
    throw InputChanged(name_, 0, "was changed by another program while it was read; try again");
}

std::uint64_t MappedFile::line_of(const char* where) const {
  return 1 + static_cast<std::uint64_t>(std::count(begin(), where, '\n'));
}

void MappedFile::fail(const char* action) const {
  throw InputError(name_, 0, std::string(action) + ": " + std::generic_category().message(errno));
}

}  // namespace mesher::io
