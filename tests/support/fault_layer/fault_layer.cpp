// A Vulkan layer that makes calls fail on a cue, so that tests see lost devices, lost surfaces and
// full memory without breaking a GPU. FaultLayer (tests/support/fault_layer.h) gives the cues.
//
// The cues are the lines of the file that MESHER_FAULT_CUE names: "CALL RESULT COUNT BYTES". The
// next COUNT calls of that name return RESULT; allocations only if they are of at least BYTES
// bytes. After the last one, the file is removed. As Vulkan demands, a lost device stays lost.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace {

struct NextInstance {
  PFN_vkGetInstanceProcAddr get = nullptr;
  PFN_vkDestroyInstance destroy = nullptr;
};

struct NextDevice {
  PFN_vkGetDeviceProcAddr get = nullptr;
  PFN_vkDestroyDevice destroy = nullptr;
  PFN_vkAllocateMemory allocate = nullptr;
  PFN_vkQueueSubmit2 submit = nullptr;
  PFN_vkWaitSemaphores wait = nullptr;
  PFN_vkQueueWaitIdle queue_idle = nullptr;
  PFN_vkDeviceWaitIdle device_idle = nullptr;
  PFN_vkAcquireNextImageKHR acquire = nullptr;
  PFN_vkQueuePresentKHR present = nullptr;
  std::atomic<bool> is_lost{false};
};

std::mutex g_mutex;
std::map<void*, NextInstance> g_instances;
std::map<void*, std::unique_ptr<NextDevice>> g_devices;

/// Objects that the loader dispatches alike, such as a device and its queues, begin with the same
/// pointer.
template <class T>
void* key_of(T object) {
  return *reinterpret_cast<void**>(object);
}

template <class T>
NextDevice& next_of(T object) {
  const std::lock_guard lock(g_mutex);
  return *g_devices.at(key_of(object));
}

/// Returns the result that a call has to return; VK_SUCCESS: its own.
VkResult cued(std::string_view call, VkDeviceSize bytes = 0) {
  const std::lock_guard lock(g_mutex);
  const char* file = std::getenv("MESHER_FAULT_CUE");
  if (file == nullptr) return VK_SUCCESS;
  std::string name;
  int result = VK_SUCCESS;
  int count = 0;
  VkDeviceSize least = 0;
  std::ifstream in(file);
  int answer = VK_SUCCESS;
  std::string rest;
  while (in >> name >> result >> count >> least) {
    if (answer == VK_SUCCESS && name == call && bytes >= least) {
      answer = result;
      if (--count == 0) continue;
    }
    rest += name + ' ' + std::to_string(result) + ' ' + std::to_string(count) + ' ' +
            std::to_string(least) + '\n';
  }
  if (answer == VK_SUCCESS) return VK_SUCCESS;
  if (rest.empty()) {
    std::filesystem::remove(file);
  } else {
    std::ofstream(file) << rest;
  }
  return static_cast<VkResult>(answer);
}

VkResult cued(NextDevice& device, std::string_view call, VkDeviceSize bytes = 0) {
  if (device.is_lost) return VK_ERROR_DEVICE_LOST;
  const VkResult result = cued(call, bytes);
  if (result == VK_ERROR_DEVICE_LOST) device.is_lost = true;
  return result;
}

/// The loader's link to the next layer, which this layer takes off the chain.
template <class CreateInfo>
CreateInfo* chain_link(const void* chain, VkStructureType type) {
  auto* link = static_cast<CreateInfo*>(const_cast<void*>(chain));
  while (link != nullptr && (link->sType != type || link->function != VK_LAYER_LINK_INFO))
    link = static_cast<CreateInfo*>(const_cast<void*>(link->pNext));
  return link;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* allocator,
                                               VkInstance* instance) {
  auto* link = chain_link<VkLayerInstanceCreateInfo>(info->pNext,
                                                     VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  const PFN_vkGetInstanceProcAddr get = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(get(nullptr, "vkCreateInstance"));
  const VkResult result = create(info, allocator, instance);
  if (result != VK_SUCCESS) return result;
  const std::lock_guard lock(g_mutex);
  g_instances[key_of(*instance)] = {
      get, reinterpret_cast<PFN_vkDestroyInstance>(get(*instance, "vkDestroyInstance"))};
  return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroy_instance(VkInstance instance,
                                            const VkAllocationCallbacks* allocator) {
  if (instance == VK_NULL_HANDLE) return;
  NextInstance next;
  {
    const std::lock_guard lock(g_mutex);
    next = g_instances.extract(key_of(instance)).mapped();
  }
  next.destroy(instance, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical,
                                             const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator,
                                             VkDevice* device) {
  if (const VkResult result = cued("vkCreateDevice"); result != VK_SUCCESS) return result;
  auto* link =
      chain_link<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  const PFN_vkGetInstanceProcAddr get_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  auto next = std::make_unique<NextDevice>();
  next->get = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create =
      reinterpret_cast<PFN_vkCreateDevice>(get_instance(VK_NULL_HANDLE, "vkCreateDevice"));
  const VkResult result = create(physical, info, allocator, device);
  if (result != VK_SUCCESS) return result;
  const auto load = [&](auto& function, const char* name) {
    function =
        reinterpret_cast<std::remove_reference_t<decltype(function)>>(next->get(*device, name));
  };
  load(next->destroy, "vkDestroyDevice");
  load(next->allocate, "vkAllocateMemory");
  load(next->submit, "vkQueueSubmit2");
  load(next->wait, "vkWaitSemaphores");
  load(next->queue_idle, "vkQueueWaitIdle");
  load(next->device_idle, "vkDeviceWaitIdle");
  load(next->acquire, "vkAcquireNextImageKHR");
  load(next->present, "vkQueuePresentKHR");
  const std::lock_guard lock(g_mutex);
  g_devices[key_of(*device)] = std::move(next);
  return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice device, const VkAllocationCallbacks* allocator) {
  if (device == VK_NULL_HANDLE) return;
  std::unique_ptr<NextDevice> next;
  {
    const std::lock_guard lock(g_mutex);
    next = std::move(g_devices.extract(key_of(device)).mapped());
  }
  next->destroy(device, allocator);
}

VKAPI_ATTR VkResult VKAPI_CALL allocate_memory(VkDevice device, const VkMemoryAllocateInfo* info,
                                               const VkAllocationCallbacks* allocator,
                                               VkDeviceMemory* memory) {
  NextDevice& next = next_of(device);
  const VkResult result = cued(next, "vkAllocateMemory", info->allocationSize);
  return result == VK_SUCCESS ? next.allocate(device, info, allocator, memory) : result;
}

VKAPI_ATTR VkResult VKAPI_CALL queue_submit(VkQueue queue, std::uint32_t count,
                                            const VkSubmitInfo2* infos, VkFence fence) {
  NextDevice& next = next_of(queue);
  const VkResult result = cued(next, "vkQueueSubmit2");
  return result == VK_SUCCESS ? next.submit(queue, count, infos, fence) : result;
}

VKAPI_ATTR VkResult VKAPI_CALL wait_semaphores(VkDevice device, const VkSemaphoreWaitInfo* info,
                                               std::uint64_t timeout) {
  NextDevice& next = next_of(device);
  const VkResult result = cued(next, "vkWaitSemaphores");
  return result == VK_SUCCESS ? next.wait(device, info, timeout) : result;
}

// A lost device does no more work, so that waiting for it ends. The real device has to be idle
// before its objects are destroyed.
VKAPI_ATTR VkResult VKAPI_CALL queue_wait_idle(VkQueue queue) {
  NextDevice& next = next_of(queue);
  const VkResult result = next.queue_idle(queue);
  return next.is_lost ? VK_ERROR_DEVICE_LOST : result;
}

VKAPI_ATTR VkResult VKAPI_CALL device_wait_idle(VkDevice device) {
  NextDevice& next = next_of(device);
  const VkResult result = next.device_idle(device);
  return next.is_lost ? VK_ERROR_DEVICE_LOST : result;
}

VKAPI_ATTR VkResult VKAPI_CALL acquire_next_image(VkDevice device, VkSwapchainKHR swapchain,
                                                  std::uint64_t timeout, VkSemaphore semaphore,
                                                  VkFence fence, std::uint32_t* index) {
  NextDevice& next = next_of(device);
  const VkResult result = cued(next, "vkAcquireNextImageKHR");
  if (result < 0) return result;
  const VkResult own = next.acquire(device, swapchain, timeout, semaphore, fence, index);
  return own == VK_SUCCESS ? result : own;
}

// A present that fails still waits for its semaphores, unless the device is lost.
VKAPI_ATTR VkResult VKAPI_CALL queue_present(VkQueue queue, const VkPresentInfoKHR* info) {
  NextDevice& next = next_of(queue);
  const VkResult result = cued(next, "vkQueuePresentKHR");
  if (result == VK_ERROR_DEVICE_LOST) return result;
  const VkResult own = next.present(queue, info);
  return own == VK_SUCCESS ? result : own;
}

template <class Function>
PFN_vkVoidFunction plain(Function function) {
  return reinterpret_cast<PFN_vkVoidFunction>(function);
}

PFN_vkVoidFunction hooked_by_device(std::string_view name) {
  if (name == "vkDestroyDevice") return plain(destroy_device);
  if (name == "vkAllocateMemory") return plain(allocate_memory);
  if (name == "vkQueueSubmit2") return plain(queue_submit);
  if (name == "vkWaitSemaphores") return plain(wait_semaphores);
  if (name == "vkQueueWaitIdle") return plain(queue_wait_idle);
  if (name == "vkDeviceWaitIdle") return plain(device_wait_idle);
  if (name == "vkAcquireNextImageKHR") return plain(acquire_next_image);
  if (name == "vkQueuePresentKHR") return plain(queue_present);
  return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_proc(VkDevice device, const char* name) {
  if (std::string_view(name) == "vkGetDeviceProcAddr") return plain(get_device_proc);
  NextDevice& next = next_of(device);
  // Of an extension that is not enabled, there is no function.
  const PFN_vkVoidFunction own = next.get(device, name);
  const PFN_vkVoidFunction hook = own == nullptr ? nullptr : hooked_by_device(name);
  return hook != nullptr ? hook : own;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_proc(VkInstance instance, const char* name) {
  const std::string_view wanted = name;
  if (wanted == "vkGetInstanceProcAddr") return plain(get_instance_proc);
  if (wanted == "vkGetDeviceProcAddr") return plain(get_device_proc);
  if (wanted == "vkCreateInstance") return plain(create_instance);
  if (wanted == "vkDestroyInstance") return plain(destroy_instance);
  if (wanted == "vkCreateDevice") return plain(create_device);
  if (const PFN_vkVoidFunction hook = hooked_by_device(wanted)) return hook;
  if (instance == VK_NULL_HANDLE) return nullptr;
  PFN_vkGetInstanceProcAddr get = nullptr;
  {
    const std::lock_guard lock(g_mutex);
    get = g_instances.at(key_of(instance)).get;
  }
  return get(instance, name);
}

}  // namespace

extern "C" VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* negotiated) {
  negotiated->loaderLayerInterfaceVersion = 2;
  negotiated->pfnGetInstanceProcAddr = get_instance_proc;
  negotiated->pfnGetDeviceProcAddr = get_device_proc;
  negotiated->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
