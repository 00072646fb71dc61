#include "engine/core/array.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <utility>

#include "engine/core/memory.h"

// g++ defines a macro; clang++ has a feature test.
#if defined(MESHER_SANITIZED)
#define MESHER_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MESHER_ADDRESS_SANITIZER
#endif
#endif

namespace mesher {
namespace {

constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kHugePage = std::size_t{2} << 20U;
// Smaller arrays come from malloc, whose heap is already mapped. Under AddressSanitizer all arrays
// do, so that it sees accesses to them.
#if defined(MESHER_ADDRESS_SANITIZER)
constexpr std::size_t kSmall = static_cast<std::size_t>(-1);
#else
constexpr std::size_t kSmall = std::size_t{128} << 10U;
#endif
// The least part of a last huge page that an array must fill to get the whole page. Filling 512 kB
// in small pages costs twice as much as clearing 2 MB at once.
constexpr std::size_t kMinHugePageTail = std::size_t{512} << 10U;

/// Rounds up to cache lines. Arrays begin on cache lines, and no two share one.
constexpr std::size_t padded(std::size_t bytes) {
  return (bytes + kCacheLine - 1) / kCacheLine * kCacheLine;
}

/// Rounds up to small pages, or to huge pages if that wastes little.
std::size_t rounded(std::size_t bytes) {
  constexpr std::size_t kPage = 4096;
  const std::size_t tail = bytes % kHugePage;
  if (tail >= kMinHugePageTail) return bytes - tail + kHugePage;
  return (bytes + kPage - 1) / kPage * kPage;
}

/// Maps pages that begin at a huge-page boundary and unmaps the excess on both sides. Returns null
/// if the system has none. Pre: `bytes` is rounded.
void* map_pages(std::size_t bytes) {
  void* memory =
      mmap(nullptr, bytes + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return nullptr;
  auto* begin = static_cast<std::byte*>(memory);
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const std::size_t before = (kHugePage - address % kHugePage) % kHugePage;
  if (before > 0) munmap(begin, before);
  munmap(begin + before + bytes, kHugePage - before);
  // Only a hint: if the kernel ignores it, the memory comes in small pages.
  madvise(begin + before, bytes, MADV_HUGEPAGE);
  return begin + before;
}

/// Allocates arrays smaller than a huge page one after the other on shared huge pages. A page is
/// free when its last array is freed. Freeing the most recent array of a page makes its bytes
/// available at once. A few free pages are kept, because clearing a page costs as much as filling
/// it.
class SharedPages {
 public:
  /// Returns null if the system has no memory.
  void* allocate(std::size_t bytes) {
    const std::size_t size = padded(bytes);
    const std::lock_guard lock(mutex_);
    if (page_ == nullptr || page_->used + size > kHugePage) {
      Page* const page = take_page();
      if (page == nullptr) return nullptr;
      page_ = page;
    }
    std::byte* array = reinterpret_cast<std::byte*>(page_) + page_->used;
    page_->used += size;
    ++page_->arrays;
    return array;
  }

  void free(void* array, std::size_t bytes) {
    const auto address = reinterpret_cast<std::uintptr_t>(array);
    const std::size_t offset = address % kHugePage;
    auto* page = reinterpret_cast<Page*>(static_cast<std::byte*>(array) - offset);
    const std::lock_guard lock(mutex_);
    if (page->used == offset + padded(bytes)) page->used = offset;
    if (--page->arrays > 0) return;
    page->used = kHeader;
    if (page != page_) give_back(page);
  }

 private:
  static constexpr std::size_t kHeader = kCacheLine;
  static constexpr std::size_t kMostKept = 16;  // 32 MB, as much as malloc keeps
  struct Page {
    std::size_t used = kHeader;
    std::size_t arrays = 0;
    Page* next_kept = nullptr;
  };

  Page* take_page() {
    if (kept_ != nullptr) {
      --kept_count_;
      return std::exchange(kept_, kept_->next_kept);
    }
    void* memory = map_pages(kHugePage);
    return memory == nullptr ? nullptr : ::new (memory) Page;
  }

  void give_back(Page* page) {
    if (kept_count_ == kMostKept) {
      munmap(page, kHugePage);
      return;
    }
    page->next_kept = std::exchange(kept_, page);
    ++kept_count_;
  }

  std::mutex mutex_;
  Page* page_ = nullptr;  ///< being filled
  Page* kept_ = nullptr;  ///< free
  std::size_t kept_count_ = 0;
};

/// Never destroyed: arrays of static objects may outlive any other static object.
SharedPages& shared_pages() {
  static auto* const kPages = new SharedPages;
  return *kPages;
}

constexpr std::size_t kShared = kHugePage - kCacheLine;

}  // namespace

void* allocate_array(std::size_t bytes) {
  // No object may be larger than that, so rounding up cannot overflow.
  if (bytes > PTRDIFF_MAX || !MemoryLimit::take(bytes)) throw std::bad_alloc();
  void* memory = nullptr;
  if (bytes < kSmall) {
    if (posix_memalign(&memory, kCacheLine, std::max<std::size_t>(bytes, 1)) != 0) memory = nullptr;
  } else if (bytes <= kShared) {
    memory = shared_pages().allocate(bytes);
  } else {
    memory = map_pages(rounded(bytes));
  }
  if (memory == nullptr) {
    MemoryLimit::give_back(bytes);
    throw std::bad_alloc();
  }
  return memory;
}

void free_array(void* memory, std::size_t bytes) noexcept {
  MemoryLimit::give_back(bytes);
  if (bytes < kSmall) {
    std::free(memory);
  } else if (bytes <= kShared) {
    shared_pages().free(memory, bytes);
  } else {
    munmap(memory, rounded(bytes));
  }
}

}  // namespace mesher
