#include "app/cli/version.h"

#include "engine/core/error.h"
#include "engine/gpu/instance.h"
#include "engine/gpu/selection.h"

namespace mesher::app {

/// Defined by a source that the build writes (cmake/commit.cmake); empty: unknown.
extern const char* const kCommit;

namespace {

std::string device_text() {
  try {
    const gpu::Instance instance;
    const auto candidates = gpu::list_candidates(instance.handle(), VK_NULL_HANDLE);
    const gpu::DeviceDescription& device = gpu::choose(candidates, "").description;
    return device.name + " (" + device.kind + ", Vulkan " + device.api_version + ")";
  } catch (const DeviceError& error) {
    return std::string("none: ") + error.what();
  }
}

}  // namespace

std::string version_text() {
  std::string text = "mesher " MESHER_VERSION;
  if (*kCommit != '\0') text += std::string(" (commit ") + kCommit + ")";
  return text + "\nVulkan device: " + device_text();
}

}  // namespace mesher::app
