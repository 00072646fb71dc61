#pragma once

#include <cstddef>

#include "engine/gpu/handles.h"

namespace mesher::gpu {

/// What memory is for; which of the device's heaps that means is decided here and nowhere else.
enum class MemoryIntent {
  fixed,    ///< written seldom, read by the GPU a lot; mapped too where the GPU's own memory can be
  dynamic,  ///< written by the CPU, read by the GPU once: staging
  readback,  ///< written by the GPU, read by the CPU
};

/// One allocation, mapped for as long as it lives where the CPU can reach it.
struct Memory {
  UniqueMemory handle;
  std::byte* mapped = nullptr;  ///< null: reach it by a copy on the GPU
};

/// Throws DeviceError where there is not enough of it. `with_address`: for buffers that shaders
/// reach by address.
Memory allocate(Device& device, const VkMemoryRequirements& requirements, MemoryIntent intent,
                bool with_address = false);

}  // namespace mesher::gpu
