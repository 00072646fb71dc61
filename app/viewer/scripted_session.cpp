#include "app/viewer/scripted_session.h"

#include "app/document/shown.h"
#include "app/edit/edits.h"
#include "app/files/leave.h"
#include "app/files/paths.h"
#include "app/input/commands.h"
#include "app/ui/overlay.h"
#include "app/ui/panels.h"
#include "app/viewer/scene_mirror.h"
#include "engine/core/error.h"
#include "engine/io/png.h"
#include "engine/render/offscreen.h"

namespace mesher::app {
namespace {

// ImGui lays out a window by its sizes in the last frame.
constexpr int kFramesToSettle = 3;

}  // namespace

struct ScriptedSession::Gpu {
  explicit Gpu(const ScriptOptions& options)
      : instance({.extensions = {}, .validation = options.validation}),
        device(instance, {.select = options.device}),
        renderer(device),
        mirror(device) {}

  gpu::Instance instance;
  gpu::Device device;
  render::Renderer renderer;
  SceneMirror mirror;
};

struct ScriptedSession::PanelLayer {
  PanelLayer(Gpu& gpu, float scale) : overlay(gpu.instance, gpu.device, kFormat, nullptr, scale) {}

  static constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;
  Overlay overlay;
  Panels panels;
};

ScriptedSession::ScriptedSession(Session& session, const ScriptOptions& options)
    : session_(session), options_(options) {}

ScriptedSession::~ScriptedSession() = default;

void ScriptedSession::press(std::span<const KeyPress> keys) {
  for (const KeyPress& key : keys) {
    if (has_question(session_)) {
      answer_question(session_, key);
      continue;
    }
    const Command* command = command_for(key);
    if (command == nullptr)
      throw UsageError("--keys: '" + to_text(key) + "' is not bound to a command");
    run(session_, *command);
    run_waiting_edits(session_.document);
    session_.document.progressive.settle(shown_pixels_per_unit(session_.document, session_.view));
    run_waiting_save(session_);
    if (session_.wants_quit) return;
    if (!session_.wants_screenshot) continue;
    session_.wants_screenshot = false;
    const std::filesystem::path file = next_screenshot(session_.document.model.name);
    io::write_png(file, picture());
    session_.document.notice = "saved " + file.string();
  }
}

PictureScene ScriptedSession::scene(std::uint32_t pixel_ratio) {
  update_mirror(pixel_ratio);
  return {.device = gpu_->device,
          .renderer = gpu_->renderer,
          .mesh = gpu_->mirror.mesh(),
          .camera = session_.view.camera,
          .settings = gpu_->mirror.settings(),
          .box = session_.document.statistics.box,
          .legend = {},
          .window = extent()};
}

void ScriptedSession::update_mirror(std::uint32_t pixel_ratio) {
  if (!gpu_) gpu_ = std::make_unique<Gpu>(options_);
  std::optional<render::PictureView> picture;
  if (pixel_ratio > 0)
    picture = {.camera = session_.view.camera,
               .size = pixel_ratio * glm::uvec2(extent().width, extent().height)};
  gpu_->mirror.update(session_.document, session_.view.settings, picture);
}

Image ScriptedSession::picture() {
  update_mirror();
  if (options_.panels) return picture_with_panels();
  return render::render_image(gpu_->device, gpu_->renderer, gpu_->mirror.mesh(),
                              session_.view.camera, gpu_->mirror.settings(), extent().width,
                              extent().height);
}

VkExtent2D ScriptedSession::extent() const {
  return {static_cast<std::uint32_t>(session_.view.window.x),
          static_cast<std::uint32_t>(session_.view.window.y)};
}

// The same steps as a frame in a window, but into an image.
Image ScriptedSession::picture_with_panels() {
  if (!panel_layer_) panel_layer_ = std::make_unique<PanelLayer>(*gpu_, options_.ui_scale);
  gpu::Device& device = gpu_->device;
  const gpu::DeviceImage image(
      device, {.format = PanelLayer::kFormat,
               .extent = extent(),
               .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                        VK_IMAGE_USAGE_TRANSFER_DST_BIT});
  for (int frame = 0; frame < kFramesToSettle; ++frame) {
    panel_layer_->overlay.begin(session_.view.window);
    panel_layer_->panels.draw(session_, {.window = session_.view.window,
                                         .upload = gpu_->mirror.last_upload(),
                                         .device = device.name()});
    panel_layer_->overlay.end();
    // Once more, with the glyphs of the names.
    if (panel_layer_->overlay.require_glyphs(panel_layer_->panels.code_points())) frame = -1;
  }
  const VkRect2D place = model_rectangle(session_.view, extent());
  const unsigned samples = device.supported_samples(session_.view.settings.samples);
  const render::SceneTarget target(device, place.extent, samples, PanelLayer::kFormat);
  device.run_once([&](VkCommandBuffer commands) {
    gpu_->renderer.draw(commands, target, gpu_->mirror.mesh(), session_.view.camera,
                        gpu_->mirror.settings());
    target.copy_to(commands, image.handle(), place.offset);
    panel_layer_->overlay.draw(commands, image.view(), extent());
  });
  panel_layer_->overlay.forget_images();
  return gpu::read_image(device, image, gpu::kColorAttachment);
}

const WidgetAreas* ScriptedSession::widgets() const {
  return panel_layer_ ? &panel_layer_->panels.widgets() : nullptr;
}

std::vector<std::string> ScriptedSession::not_drawn() const {
  return gpu_ ? gpu_->mirror.not_drawn() : std::vector<std::string>{};
}

void ScriptedSession::expect_no_messages() const {
  if (!gpu_ || gpu_->instance.messages().count() == 0) return;
  throw DeviceError("validation: " + gpu_->instance.messages().list().front());
}

}  // namespace mesher::app
