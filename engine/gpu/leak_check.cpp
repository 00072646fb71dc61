#include "engine/gpu/leak_check.h"

#ifdef __SANITIZE_ADDRESS__

#include <dlfcn.h>

// Validation layer 1.3.239 (Debian 12) loses its bookkeeping of queues, command buffers and shaders
// of every device: some 50 blocks a test, all allocated by the layer itself. We lose nothing. The
// name is the sanitizer's.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libVkLayer_khronos_validation.so\n";
}

namespace mesher::gpu {

void excuse_leaks_of_others(bool validation) {
  // The loader unloads layer and driver with the instance. Leaks of what is gone have no name, and
  // what the driver's own globals pointed to (lavapipe: 128 bytes a device) looks lost.
  if (validation) dlopen("libVkLayer_khronos_validation.so", RTLD_LAZY | RTLD_NODELETE);
  dlopen("libvulkan_lvp.so", RTLD_LAZY | RTLD_NODELETE);
}

}  // namespace mesher::gpu

#else

namespace mesher::gpu {

void excuse_leaks_of_others(bool /*validation*/) {}

}  // namespace mesher::gpu

#endif
