#include "app/ui/overlay.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>

#include "app/ui/controls.h"
#include "app/ui/style.h"
#include "engine/core/error.h"
#include "engine/gpu/result.h"

namespace mesher::app {
namespace {

/// Keys that move the keyboard focus, or press the focused widget.
constexpr std::array<std::string_view, 9> kFocusKeys{"tab",  "enter", "space", "up", "down",
                                                     "left", "right", "home",  "end"};

void check_imgui(VkResult result) {
  gpu::check(result, "ImGui");
}

void upload_fonts([[maybe_unused]] gpu::Device& device) {
#if IMGUI_VERSION_NUM < 19000
  device.run_once([](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
  ImGui_ImplVulkan_DestroyFontUploadObjects();
#else
  // Debian 13's ImGui has a command buffer of its own.
  ImGui_ImplVulkan_CreateFontsTexture();
#endif
}

}  // namespace

Overlay::Overlay(const gpu::Instance& instance, gpu::Device& device, VkFormat format,
                 GLFWwindow* window, float scale)
    : instance_(instance),
      device_(&device),
      context_(ImGui::CreateContext()),
      fonts_(scale, device.properties().limits.maxImageDimension2D),
      has_window_(window != nullptr) {
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().LogFilename = nullptr;
  if (has_window_) ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  set_sizes(scale);
  if (has_window_) ImGui_ImplGlfw_InitForVulkan(window, true);
  attach(device, format);
}

Overlay::~Overlay() {
  detach();
  if (has_window_) ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext(context_);
}

void Overlay::detach() {
  if (device_ == nullptr) return;
  // Not Device::wait_idle, which throws. A lost device does no more work.
  vkDeviceWaitIdle(device_->handle());
  // There is none if it could not be started.
  if (ImGui::GetIO().BackendRendererUserData != nullptr) ImGui_ImplVulkan_Shutdown();
  framebuffers_.clear();
  descriptor_pool_ = {};
  render_pass_ = {};
  device_ = nullptr;
}

void Overlay::attach(gpu::Device& device, VkFormat format) {
  device_ = &device;
  create_render_pass(format);
  create_descriptor_pool();
  start_renderer();
}

void Overlay::create_render_pass(VkFormat format) {
  const VkAttachmentDescription attachment{
      .flags = 0,
      .format = format,
      .samples = VK_SAMPLE_COUNT_1_BIT,
      .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
      .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
      .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
      .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
      .initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
      .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &reference;
  // The barrier of the copy that wrote the image already waits for that copy.
  const VkSubpassDependency after_scene{
      .srcSubpass = VK_SUBPASS_EXTERNAL,
      .dstSubpass = 0,
      .srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
      .dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
      .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
      .dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
      .dependencyFlags = 0};
  VkRenderPassCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.attachmentCount = 1;
  info.pAttachments = &attachment;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = 1;
  info.pDependencies = &after_scene;
  VkRenderPass pass = VK_NULL_HANDLE;
  gpu::check(vkCreateRenderPass(device_->handle(), &info, nullptr, &pass), "vkCreateRenderPass");
  render_pass_ = {*device_, pass};
}

void Overlay::create_descriptor_pool() {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  info.maxSets = 4;
  info.poolSizeCount = 1;
  info.pPoolSizes = &size;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  gpu::check(vkCreateDescriptorPool(device_->handle(), &info, nullptr, &pool),
             "vkCreateDescriptorPool");
  descriptor_pool_ = {*device_, pool};
}

void Overlay::start_renderer() {
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = instance_.handle();
  info.PhysicalDevice = device_->physical();
  info.Device = device_->handle();
  info.QueueFamily = device_->queue_family();
  info.Queue = device_->queue();
  info.DescriptorPool = descriptor_pool_.get();
  // Number of vertex buffers of ImGui: more than there can be frames in flight.
  info.MinImageCount = 3;
  info.ImageCount = 3;
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = check_imgui;
  ImGui_ImplVulkan_Init(&info, render_pass_.get());
  upload_fonts(*device_);
}

/// Replaces the texture of the font, which frames in flight may use.
void Overlay::restart_renderer() {
  device_->wait_idle();
#if IMGUI_VERSION_NUM < 19000
  // This version cannot replace the texture alone, and leaves its descriptor set in the pool.
  ImGui_ImplVulkan_Shutdown();
  gpu::check(vkResetDescriptorPool(device_->handle(), descriptor_pool_.get(), 0),
             "vkResetDescriptorPool");
  start_renderer();
#else
  upload_fonts(*device_);
#endif
}

void Overlay::set_scale(float scale) {
  set_sizes(scale);
  fonts_.set_scale(scale);
}

void Overlay::begin(const glm::dvec2& size) {
  if (fonts_.update()) restart_renderer();
  ImGui_ImplVulkan_NewFrame();
  if (has_window_) {
    ImGui_ImplGlfw_NewFrame();
  } else {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(size.x), static_cast<float>(size.y)};
    io.DeltaTime = 1.0F / 60.0F;
  }
  press_if_asked();
  ImGui::NewFrame();
}

void Overlay::press_if_asked() {
#if IMGUI_VERSION_NUM < 18700
  // Enter only begins to edit text in this version: buttons, check boxes and entries of lists take
  // Space alone. If it does both, a field for text still takes the first.
  if (presses_focused_ && context_->ActiveId == 0)
    ImGui::GetIO().NavInputs[ImGuiNavInput_Activate] = 1.0F;
#endif
  presses_focused_ = false;
}

void Overlay::end() {
#if IMGUI_VERSION_NUM < 19000
  if (ignored_frames_ > 0) {
    --ignored_frames_;
    context_->NavDisableHighlight = true;
    context_->NavDisableMouseHover = false;
  }
#endif
  ImGui::Render();
}

void Overlay::draw(VkCommandBuffer commands, VkImageView view, VkExtent2D extent) {
  UniqueFramebuffer& framebuffer = framebuffers_[view];
  if (!framebuffer) {
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = render_pass_.get();
    info.attachmentCount = 1;
    info.pAttachments = &view;
    info.width = extent.width;
    info.height = extent.height;
    info.layers = 1;
    VkFramebuffer handle = VK_NULL_HANDLE;
    gpu::check(vkCreateFramebuffer(device_->handle(), &info, nullptr, &handle),
               "vkCreateFramebuffer");
    framebuffer = {*device_, handle};
  }
  VkRenderPassBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  begin.renderPass = render_pass_.get();
  begin.framebuffer = framebuffer.get();
  begin.renderArea.extent = extent;
  vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
  vkCmdEndRenderPass(commands);
}

bool Overlay::wants_text() const {
  return ImGui::GetIO().WantTextInput;
}

void Overlay::release_keyboard() {
  ImGui::ClearActiveID();
  ImGui::FocusWindow(nullptr);
  ImGui::GetIO().WantTextInput = false;
  context_->WantTextInputNextFrame = -1;  // the field was still drawn in this frame
}

bool Overlay::takes_key(std::string_view name) const {
  if (std::ranges::count(kFocusKeys, name) == 0) return false;
  // Once the tool's panel was clicked, Tab goes to its next field.
  const ImGuiWindow* focused = context_->NavWindow;
  const bool is_in_panel =
      focused != nullptr && std::string_view(focused->RootWindow->Name) == kToolPanel;
  return ImGui::GetIO().NavVisible || (name == "tab" && is_in_panel);
}

void Overlay::ignore_key(std::string_view name) {
  constexpr int kFrames = 3;  // a key is down for about that long
  if (std::ranges::count(kFocusKeys, name) > 0) ignored_frames_ = kFrames;
}

void Overlay::copy(const std::string& text) const {
  ImGui::SetClipboardText(text.c_str());
}

bool Overlay::close_popups() {
  constexpr ImGuiPopupFlags kAny = ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel;
  if (!ImGui::IsPopupOpen("", kAny)) return false;
  ImGui::ClosePopupToLevel(0, true);
  return true;
}

}  // namespace mesher::app
