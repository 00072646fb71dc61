#include "engine/io/byte_stream.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "engine/core/error.h"

namespace mesher::io {
namespace {

// Longest time that a silent pipe delays the end of reading.
constexpr int kPollMilliseconds = 50;

std::string reason(int error) {
  return "cannot be read (" + std::generic_category().message(error) + ")";
}

}  // namespace

ByteStream::ByteStream(const std::filesystem::path& file) : file_(file) {
  // Without O_NONBLOCK, opening a named pipe would block until a writer opens it.
  descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0) throw InputError(file.string(), 0, reason(errno));
  thread_ = std::thread([this] { run(); });
}

ByteStream::~ByteStream() {
  close();
  thread_.join();
  ::close(descriptor_);
}

void ByteStream::close() {
  {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
    blocks_.clear();
    waiting_bytes_ = 0;
  }
  changed_.notify_all();
}

void ByteStream::run() {
  while (read_block()) {
  }
  {
    const std::lock_guard lock(mutex_);
    is_done_ = true;
  }
  tell();
}

void ByteStream::tell() {
  changed_.notify_all();
  const std::lock_guard lock(mutex_);
  if (wake_ != nullptr) wake_();
}

void ByteStream::set_wake(void (*wake)()) {
  const std::lock_guard lock(mutex_);
  wake_ = wake;
}

/// Returns false if reading is finished.
bool ByteStream::read_block() {
  // poll does not report a pipe that never had a writer. It reports one whose writers have all
  // closed, and read then returns the end of the file.
  pollfd waiting{descriptor_, POLLIN, 0};
  const int ready = ::poll(&waiting, 1, kPollMilliseconds);
  if (ready == 0 || (ready < 0 && errno == EINTR)) return put({});
  Block block(kBlockBytes);
  const ssize_t bytes = ready < 0 ? -1 : ::read(descriptor_, block.data(), block.size());
  if (bytes > 0) {
    block.resize(static_cast<std::size_t>(bytes));
    return put(std::move(block));
  }
  if (bytes < 0 && (errno == EINTR || errno == EAGAIN)) return put({});
  if (bytes < 0) {
    const std::lock_guard lock(mutex_);
    failure_ = reason(errno);
  }
  return false;
}

/// Returns false if the stream has been closed.
bool ByteStream::put(Block&& block) {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return has_room(); });
    if (is_stopped_) return false;
    if (block.empty()) return true;
    waiting_bytes_ += block.size();
    blocks_.push_back(std::move(block));
  }
  tell();
  return true;
}

ByteStream::Block ByteStream::take() {
  Block block;
  {
    const std::lock_guard lock(mutex_);
    if (blocks_.empty()) return block;
    block = std::move(blocks_.front());
    blocks_.pop_front();
    waiting_bytes_ -= block.size();
  }
  changed_.notify_all();
  return block;
}

bool ByteStream::has_news() const {
  const std::lock_guard lock(mutex_);
  return !blocks_.empty() || is_done_;
}

bool ByteStream::is_at_end() const {
  const std::lock_guard lock(mutex_);
  return blocks_.empty() && is_done_;
}

void ByteStream::wait() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !blocks_.empty() || is_done_; });
}

std::string ByteStream::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

}  // namespace mesher::io
