#include "engine/io/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "engine/core/error.h"

namespace mesher {
namespace {

constexpr std::size_t kReadBlock = std::size_t{1} << 20;

struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& file) : name_(file.string()) {
  const Descriptor in{::open(file.c_str(), O_RDONLY | O_CLOEXEC)};
  if (in.fd < 0) fail("cannot open");
  struct stat status = {};
  if (::fstat(in.fd, &status) != 0) fail("cannot open");
  if (S_ISDIR(status.st_mode)) throw InputError(name_, 0, "is a directory");
  // Files under /proc say that they are empty and are not: those are read.
  if (S_ISREG(status.st_mode) && status.st_size > 0) {
    map(in.fd, static_cast<std::size_t>(status.st_size));
  } else {
    read_blocks(in.fd);
  }
}

MappedFile::~MappedFile() {
  if (mapped_bytes_ != 0) ::munmap(const_cast<char*>(data_), mapped_bytes_);
}

void MappedFile::map(int descriptor, std::size_t size) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  // The padding: anonymous pages one further than the file needs, and the file laid over them. The
  // kernel zeroes what is left of the file's last page.
  const std::size_t bytes = (size / page + 2) * page;
  void* const area = ::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (area == MAP_FAILED) fail("cannot map");
  if (::mmap(area, size, PROT_READ, MAP_PRIVATE | MAP_FIXED, descriptor, 0) == MAP_FAILED) {
    const int error = errno;
    ::munmap(area, bytes);
    errno = error;
    fail("cannot map");
  }
  ::madvise(area, size, MADV_SEQUENTIAL);
  data_ = static_cast<const char*>(area);
  size_ = size;
  mapped_bytes_ = bytes;
}

void MappedFile::read_blocks(int descriptor) {
  for (;;) {
    if (copy_.size() < size_ + kReadBlock) {
      copy_.resize(std::max(2 * copy_.size(), size_ + kReadBlock) + kPadding);
    }
    const ssize_t got = ::read(descriptor, copy_.data() + size_, kReadBlock);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("cannot read");
    if (got == 0) break;
    size_ += static_cast<std::size_t>(got);
  }
  copy_.resize(size_ + kPadding);
  std::memset(copy_.data() + size_, 0, kPadding);
  data_ = copy_.data();
}

std::uint64_t MappedFile::line_of(const char* where) const {
  return 1 + static_cast<std::uint64_t>(std::count(begin(), where, '\n'));
}

void MappedFile::fail(const char* action) const {
  throw InputError(name_, 0, std::string(action) + ": " + std::generic_category().message(errno));
}

}  // namespace mesher
