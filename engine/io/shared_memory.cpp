#include "engine/io/shared_memory.h"

#include <sys/mman.h>

#include <new>

#include "engine/core/memory.h"

namespace mesher::io {

SharedMemory::SharedMemory(std::size_t bytes) : size_(bytes) {
  if (!MemoryLimit::take(bytes)) throw std::bad_alloc();
  void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                              MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) {
    MemoryLimit::give_back(bytes);
    throw std::bad_alloc();
  }
  // Only a hint: if the kernel ignores it, the memory comes in small pages.
  ::madvise(memory, bytes, MADV_HUGEPAGE);
  data_ = static_cast<std::uint8_t*>(memory);
}

SharedMemory::~SharedMemory() {
  ::munmap(data_, size_);
  MemoryLimit::give_back(size_);
}

}  // namespace mesher::io
