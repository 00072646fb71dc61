#include "app/scripted_session.h"

#include "app/commands.h"
#include "app/paths.h"
#include "engine/core/error.h"
#include "engine/io/png.h"
#include "engine/render/offscreen.h"

namespace mesher::app {

struct ScriptedSession::Gpu {
  explicit Gpu(const ScriptOptions& options)
      : instance({.extensions = {}, .validation = options.validation}),
        device(instance, {.select = options.device}),
        renderer(device),
        mesh(device) {}

  gpu::Instance instance;
  gpu::Device device;
  render::Renderer renderer;
  render::GpuMesh mesh;
  std::uint64_t generation = 0;
};

ScriptedSession::ScriptedSession(Session& session, const ScriptOptions& options)
    : session_(session), options_(options) {}

ScriptedSession::~ScriptedSession() = default;

void ScriptedSession::press(std::span<const KeyPress> keys) {
  for (const KeyPress& key : keys) {
    const auto command = command_for(key);
    if (!command) throw UsageError("--keys: '" + to_text(key) + "' does nothing");
    run(session_, *command);
    if (session_.wants_quit) return;
    if (!session_.wants_screenshot) continue;
    session_.wants_screenshot = false;
    const std::filesystem::path file = next_screenshot(session_.model.name);
    write_png(file, picture());
    session_.notice = "saved " + file.string();
  }
}

Image ScriptedSession::picture() {
  if (!gpu_) gpu_ = std::make_unique<Gpu>(options_);
  if (gpu_->generation != session_.model_generation) gpu_->mesh.invalidate();
  gpu_->generation = session_.model_generation;
  gpu_->mesh.apply(session_.model.mesh, session_.settings);
  return render::render_image(gpu_->device, gpu_->renderer, gpu_->mesh, session_.camera,
                              session_.settings, static_cast<std::uint32_t>(session_.window.x),
                              static_cast<std::uint32_t>(session_.window.y));
}

void ScriptedSession::expect_no_messages() const {
  if (!gpu_ || gpu_->instance.messages().count() == 0) return;
  throw DeviceError("validation: " + gpu_->instance.messages().list().front());
}

}  // namespace mesher::app
