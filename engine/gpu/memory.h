#pragma once

#include <cstddef>

#include "engine/gpu/handles.h"

namespace mesher::gpu {

/// Purpose of memory. Only this module maps a purpose to the device's heaps.
enum class MemoryIntent {
  fixed,     ///< written rarely, read by the GPU often; mapped if the GPU's own memory can be
  dynamic,   ///< written by the CPU, read by the GPU once: staging
  readback,  ///< written by the GPU, read by the CPU
};

/// One allocation. It stays mapped for its lifetime if the CPU can access it.
struct Memory {
  UniqueMemory handle;
  std::byte* mapped = nullptr;  ///< null: access it by a copy on the GPU
};

/// Allocates memory. `with_address`: for buffers that shaders access by address. Throws DeviceError
/// if out of memory.
Memory allocate(Device& device, const VkMemoryRequirements& requirements, MemoryIntent intent,
                bool with_address = false);

}  // namespace mesher::gpu
