#include "engine/core/array.h"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>

namespace mesher {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20U;
// Smaller ones come from malloc, which has its memory at hand; under AddressSanitizer all do, so
// that it sees what is done to them.
#if defined(__SANITIZE_ADDRESS__)
constexpr std::size_t kLarge = static_cast<std::size_t>(-1);
#else
constexpr std::size_t kLarge = kHugePage;
#endif

/// Pages of their own, from the start of a huge page on. What lies before and after goes back at
/// once; the last, broken huge page is filled with small ones, so that nothing is rounded up.
void* map_pages(std::size_t bytes) {
  const std::size_t reserved = bytes + kHugePage;
  void* memory =
      mmap(nullptr, reserved, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return nullptr;
  auto* begin = static_cast<std::byte*>(memory);
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const std::size_t before = (kHugePage - address % kHugePage) % kHugePage;
  if (before > 0) munmap(begin, before);
  if (before < kHugePage) munmap(begin + before + bytes, kHugePage - before);
  // Advice only: where it is not taken, memory comes in small pages.
  madvise(begin + before, bytes, MADV_HUGEPAGE);
  return begin + before;
}

std::size_t whole_pages(std::size_t bytes) {
  constexpr std::size_t kPage = 4096;
  return (bytes + kPage - 1) / kPage * kPage;
}

}  // namespace

void* allocate_array(std::size_t bytes) {
  void* memory = nullptr;
  if (bytes < kLarge) {
    memory = std::malloc(bytes == 0 ? 1 : bytes);
  } else if (bytes <= static_cast<std::size_t>(-1) - 2 * kHugePage) {
    memory = map_pages(whole_pages(bytes));
  }
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void free_array(void* memory, std::size_t bytes) noexcept {
  if (bytes < kLarge) {
    std::free(memory);
  } else {
    munmap(memory, whole_pages(bytes));
  }
}

}  // namespace mesher
