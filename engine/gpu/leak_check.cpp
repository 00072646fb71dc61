#include "engine/gpu/leak_check.h"

#ifdef MESHER_SANITIZED

#include <dlfcn.h>

// Validation layer 1.3.239 (Debian 12) leaks its bookkeeping of every device's queues, command
// buffers and shaders: about 50 blocks per test, all allocated by the layer itself. mesher leaks
// nothing. lavapipe of Mesa 22.3 leaks one block per device, and what it refers to, when it
// compiles the shader of materials (not those of the other looks, which use the same sets and
// textures); the validation layer reports objects that are not destroyed. libXrandr leaks 32 bytes
// on a display without the extension. The sanitizer requires these function names.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libVkLayer_khronos_validation.so\nleak:libvulkan_lvp.so\nleak:libXrandr.so\n";
}
// The list of suppressions would mix with the program's own messages.
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() {
  return "print_suppressions=0";
}

namespace mesher::gpu {

void suppress_third_party_leaks(bool validation) {
  // The loader unloads the layer and the driver with the instance. Leaks of unloaded code have no
  // name, and memory reachable only from the driver's globals (lavapipe: 128 bytes per device)
  // looks leaked.
  if (validation) dlopen("libVkLayer_khronos_validation.so", RTLD_LAZY | RTLD_NODELETE);
  dlopen("libvulkan_lvp.so", RTLD_LAZY | RTLD_NODELETE);
  dlopen("libXrandr.so.2", RTLD_LAZY | RTLD_NODELETE);
}

}  // namespace mesher::gpu

#else

namespace mesher::gpu {

void suppress_third_party_leaks(bool /*validation*/) {}

}  // namespace mesher::gpu

#endif
