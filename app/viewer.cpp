#include "app/viewer.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "app/arrival_runner.h"
#include "app/commands.h"
#include "app/edit_runner.h"
#include "app/gestures.h"
#include "app/load_job.h"
#include "app/paths.h"
#include "app/pm_file.h"
#include "app/progressive_edits.h"
#include "app/state_log.h"
#include "app/ui/overlay.h"
#include "app/ui/panels.h"
#include "app/window.h"
#include "engine/gpu/presenter.h"
#include "engine/io/png.h"
#include "engine/render/offscreen.h"
#include "engine/render/renderer.h"

namespace mesher::app {
namespace {

constexpr double kJobPollSeconds = 0.1;
constexpr double kCaretBlinkSeconds = 0.4;
// Of each frame, for reading on where a progressive mesh arrives.
constexpr double kArrivalSeconds = 0.008;
// Past it, edges are not smoothed while things move.
constexpr double kLongFrameMs = 40.0;
// A frame that took longer does not make what moves jump.
constexpr double kLongestStepSeconds = 0.1;
// ImGui settles its layout over a few frames after an event.
constexpr int kFramesAfterEvent = 3;

class Viewer {
 public:
  Viewer(Session& session, const ViewerOptions& options, std::unique_ptr<PmArrival>& arrival)
      : session_(session),
        options_(options),
        window_(glm::ivec2(session.window), "mesher"),
        instance_({.extensions = Window::instance_extensions(), .validation = options.validation}),
        surface_(instance_, window_.create_surface(instance_.handle())),
        device_(instance_, {.select = options.device, .surface = surface_.handle()}),
        presenter_(device_, surface_.handle()),
        renderer_(device_),
        mesh_(device_),
        gestures_(session),
        edits_(session, Window::wake),
        arrivals_(session, edits_, Window::wake),
        log_(options.state_log) {
    window_.set_events(events());
    overlay_ = std::make_unique<Overlay>(instance_, device_, presenter_.format(), window_.handle());
    arrivals_.take_over(std::move(arrival));
  }

  void run(const std::vector<KeyPress>& keys) {
    prepare_scene();
    press(keys);
    while (!session_.wants_quit && !window_.should_close()) {
      wait();
      finish_load();
      if (arrivals_.advance(kArrivalSeconds)) want_frames();
      if (edits_.advance()) want_frames();
      animate();
      advance_save();
      update_hover();
      if (frames_wanted_ > 0) draw();
      if (session_.wants_screenshot) save_screenshot();
      log_.note(session_, &pointer_);
    }
    finish_saves();
    device_.wait_idle();
    if (instance_.messages().count() > 0) {
      throw DeviceError("validation: " + instance_.messages().list().front());
    }
  }

 private:
  struct Drawn {
    render::Settings settings;
    render::Camera camera;
    friend bool operator==(const Drawn&, const Drawn&) = default;
  };

  // As in a script, each key finds done what came before it.
  void press(const std::vector<KeyPress>& keys) {
    if (!keys.empty()) arrivals_.finish();
    edits_.finish();
    for (const KeyPress& key : keys) {
      press_key(key);
      edits_.finish();
      session_.progressive.settle(shown_pixels_a_unit(session_));
      prepare_scene();
      if (session_.wants_screenshot) save_screenshot();
      if (session_.wants_quit) break;
    }
  }

  Window::Events events() {
    return {.key = [this](const KeyPress& key) { press_key(key); },
            .press =
                [this](MouseButton button, Modifiers modifiers, glm::dvec2 at) {
                  pointer_.is_pressed = true;
                  if (!panels_.covers(at)) gestures_.press(button, modifiers, at, Window::time());
                  want_frames();
                },
            .release =
                [this] {
                  pointer_.is_pressed = false;
                  gestures_.release();
                  want_frames();
                },
            .move = [this](glm::dvec2 at) { move(at); },
            .scroll =
                [this](double steps) {
                  if (!panels_.covers(pointer_.at)) gestures_.scroll(steps, pointer_.at);
                  want_frames();
                },
            .drop =
                [this](std::vector<std::filesystem::path> files) {
                  if (!files.empty()) open(files.front());
                },
            .changed = [this] { want_frames(); }};
  }

  // What changes the picture may change what is under the cursor.
  void want_frames() {
    frames_wanted_ = kFramesAfterEvent;
    is_hover_old_ = true;
  }

  // Over the bare picture a move without a drag changes nothing but the edge under the cursor: no
  // need to draw.
  void move(const glm::dvec2& at) {
    const bool touches_panel = panels_.covers(at) || panels_.covers(pointer_.at);
    pointer_.at = at;
    is_hover_old_ = true;
    if (gestures_.move(at) || touches_panel) want_frames();
  }

  // Once for all the moves that have come since: it takes a look at every face.
  void update_hover() {
    if (!is_hover_old_ || !session_.creases.is_on) return;
    const bool is_over_model = !gestures_.is_dragging() && !panels_.covers(pointer_.at);
    if (hover_edge(session_, is_over_model ? std::optional(pointer_.at) : std::nullopt))
      want_frames();
    is_hover_old_ = false;
  }

  void press_key(const KeyPress& key) {
    want_frames();
    // A dialog takes the keyboard at once, ImGui's field only when it has been drawn.
    const bool has_dialog = session_.shows_open_dialog || session_.saving.shows_dialog;
    const bool is_typing = has_dialog || overlay_->wants_text();
    if (key.name == "escape") {
      if (overlay_->close_popups()) return;
      if (load_) return load_->cancel();
      if (edits_.is_running()) return edits_.cancel();
      if (arrivals_.is_running()) return arrivals_.stop();
      if (is_typing && !has_dialog) return;  // ImGui ends the typing
    } else if (is_typing) {
      // ImGui looks at keys once a frame, and misses one that was let go by then.
      if (key.name == "enter") submit_dialog();
      return;
    }
    if (const auto command = command_for(key)) app::run(session_, *command);
  }

  void submit_dialog() {
    if (session_.shows_open_dialog) panels_.submit_path();
    if (session_.saving.shows_dialog) panels_.submit_save();
  }

  void open(const std::filesystem::path& file) {
    session_.shows_open_dialog = false;
    session_.saving.shows_dialog = false;
    session_.error.clear();
    want_frames();
    if (is_pm_file(file)) {
      if (arrivals_.open(file)) load_.reset();
      return;
    }
    load_ = std::make_unique<LoadJob>(file, options_.read, Window::wake);
  }

  /// What moves by itself: by the time since the frame before, where it moved then, too.
  void animate() {
    const double now = Window::time();
    const double step = is_moving_ ? std::min(now - moved_at_s_, kLongestStepSeconds) : 0.0;
    moved_at_s_ = now;
    is_moving_ = session_.progressive.advance(step, shown_pixels_a_unit(session_));
    if (is_moving_) want_frames();
  }

  void wait() {
    if (frames_wanted_ > 0 || arrivals_.has_news()) return Window::poll_events();
    if (running_job() != nullptr) {
      want_frames();  // the progress bar
      return Window::wait_events(kJobPollSeconds);
    }
    if (overlay_->wants_text()) {
      want_frames();  // the caret
      return Window::wait_events(kCaretBlinkSeconds);
    }
    Window::wait_events(arrivals_.is_running() ? kJobPollSeconds : -1.0);
  }

  /// What a person waits for, if anything.
  const Job* running_job() const {
    if (load_) return load_.get();
    return edits_.is_running() ? edits_.job() : save_.get();
  }

  void finish_load() {
    if (!load_ || !load_->is_done()) return;
    const std::unique_ptr<LoadJob> job = std::move(load_);
    want_frames();
    try {
      show(job->take());
    } catch (const Cancelled&) {
      session_.notice = "cancelled: " + job->file().string();
    } catch (const std::exception& error) {
      session_.error = error.what();
    }
  }

  /// Takes what has been written, and begins to write what waits.
  void advance_save() {
    try {
      if (save_ && save_->is_done()) {
        const std::unique_ptr<JobOf<Saved>> job = std::move(save_);
        want_frames();
        finish_save(session_, job->take());
      }
      if (!save_) start_save();
    } catch (const std::exception& error) {
      session_.error = error.what();
    }
  }

  void start_save() {
    const auto task = begin_save(session_);
    if (!task) return;
    save_ = std::make_unique<JobOf<Saved>>(
        "Saving " + task->file.filename().string(),
        [task = *task](Progress&) { return app::perform(task); }, Window::wake);
  }

  // The window closes: what goes wrong now is no longer read there, so it goes to whoever called.
  void finish_saves() {
    while (save_ || session_.saving.waiting) {
      if (!save_) start_save();
      save_->wait();
      const std::unique_ptr<JobOf<Saved>> job = std::move(save_);
      job->take();
    }
  }

  // What the GPU cannot hold is refused, and what was shown before stays.
  void show(LoadedModel&& loaded) {
    arrivals_.stop();
    edits_.stop();
    Session before;
    std::swap(before.progressive, session_.progressive);
    session_.progressive.change(before.progressive.settings());
    std::swap(before.model, session_.model);
    std::swap(before.edits, session_.edits);
    before.statistics = session_.statistics;
    before.file = session_.file;
    before.camera = session_.camera;
    show_model(session_, std::move(loaded.model), loaded.statistics, loaded.file);
    try {
      upload();
    } catch (const Error& error) {
      show_model(session_, std::move(before.model), before.statistics, before.file);
      session_.edits = std::move(before.edits);
      session_.progressive = std::move(before.progressive);
      if (session_.progressive.is_on()) enter_progressive(session_);
      session_.camera = before.camera;
      session_.error = error.what();
    }
  }

  void draw() {
    --frames_wanted_;
    const double start = Window::time();
    if (!prepare_scene()) return;
    const glm::uvec2 size = window_.framebuffer_size();
    auto frame = presenter_.begin({size.x, size.y});
    if (!frame) return;
    session_.window = {frame->extent.width, frame->extent.height};
    draw_panels();
    draw_scene(*frame);
    target_->copy_to(frame->commands, frame->image);
    overlay_->draw(frame->commands, frame->view, frame->extent);
    presenter_.end(*frame);
    frame_ms_ = 1000.0 * (Window::time() - start);
    update_title();
  }

  void draw_panels() {
    if (presenter_.generation() != framebuffers_of_) overlay_->forget_images();
    framebuffers_of_ = presenter_.generation();
    overlay_->begin(session_.window);
    const PanelActions actions =
        panels_.draw(session_, {.job = running_job(),
                                .can_cancel = load_ != nullptr || edits_.is_running(),
                                .upload = upload_,
                                .frame_ms = frame_ms_,
                                .device = device_.name()});
    overlay_->end();
    if (actions.cancels_job && load_) {
      load_->cancel();
    } else if (actions.cancels_job) {
      edits_.cancel();
    }
    if (!actions.open.empty()) open(actions.open);
    if (actions.wants_frames || !session_.edits.waiting.empty()) want_frames();
  }

  /// Brings the GPU's mirror up to date. Throws DeviceError.
  void upload() {
    if (mesh_generation_ != session_.model_generation) {
      mesh_.invalidate();
      drawn_.reset();
      mesh_generation_ = session_.model_generation;
    }
    const std::uint32_t faces_before = mesh_.face_count();
    const render::UploadStats stats =
        mesh_.apply(shown_mesh(session_), shown_settings(session_), shown_sources(session_));
    if (mesh_.mark(marked_edges(session_))) drawn_.reset();
    uploaded_revision_ = session_.edits.revision;
    if (stats.uploaded_bytes == 0 && mesh_.face_count() == faces_before) return;
    upload_ = stats;
    drawn_.reset();
  }

  /// Everything that a frame needs and that can fail for want of memory, before the frame begins.
  /// Where a change of settings or an edit was too much, takes it back and says so.
  bool prepare_scene() {
    try {
      upload();
      drawable_settings_ = session_.settings;
      drawn_settings_ = shown_settings(session_);
      return true;
    } catch (const Error& error) {
      if (!take_back_settings() && !take_back_edit() && !take_back_mode()) throw;
      session_.error = error.what();
      mesh_.invalidate();
      want_frames();
      return false;
    }
  }

  bool take_back_settings() {
    if (!drawable_settings_ || *drawable_settings_ == session_.settings) return false;
    session_.settings = *drawable_settings_;
    return true;
  }

  // What runs or waits would go on from what cannot be shown.
  bool take_back_edit() {
    if (!uploaded_revision_ || *uploaded_revision_ == session_.edits.revision) return false;
    edits_.stop();
    return take_back_last_edit(session_);
  }

  // The whole of what comes from a file was never shown by itself: less of it may still fit.
  bool take_back_mode() {
    ProgressiveView& view = session_.progressive;
    if (!view.is_on()) return false;
    arrivals_.stop();
    const std::uint32_t level = view.is_on() ? view.mesh().level() : 0;
    if (level > 0 && view.levels().vertex_source.empty()) {
      view.move_to_level(level / 2);
    } else {
      forget_progressive(session_);
    }
    return true;
  }

  /// While the picture changes from frame to frame and that takes long, to follow the hand counts
  /// for more than smooth edges. They come with the first frame that has nothing new to show.
  unsigned samples_for(const Drawn& now) {
    const bool changes = drawn_ != now;
    is_hurried_ = changes && has_changed_ && (is_hurried_ || frame_ms_ > kLongFrameMs);
    has_changed_ = changes;
    if (is_hurried_) want_frames();
    return is_hurried_ ? 1 : now.settings.samples;
  }

  void draw_scene(const gpu::Frame& frame) {
    const Drawn now{*drawn_settings_, session_.camera};
    const unsigned samples = device_.supported_samples(samples_for(now));
    if (!target_ || target_->extent().width != frame.extent.width ||
        target_->extent().height != frame.extent.height || target_->samples() != samples) {
      target_.emplace(device_, frame.extent, samples, presenter_.format());
      drawn_.reset();
    }
    // Panels may just have changed the settings; the mirror follows before the next frame.
    if (session_.settings != *drawable_settings_) want_frames();
    if (drawn_ == now) return;  // only the panels changed
    renderer_.draw(frame.commands, *target_, mesh_, now.camera, now.settings);
    drawn_ = now;
  }

  void update_title() {
    const std::string title = session_.model.name + " - " +
                              std::to_string(shown_mesh(session_).face_count()) + " faces - mesher";
    if (title != title_) window_.set_title(title);
    title_ = title;
  }

  void save_screenshot() {
    session_.wants_screenshot = false;
    want_frames();
    if (!prepare_scene()) return;
    const std::filesystem::path file = next_screenshot(session_.model.name);
    try {
      write_png(file,
                render::render_image(device_, renderer_, mesh_, session_.camera, *drawn_settings_,
                                     static_cast<std::uint32_t>(session_.window.x),
                                     static_cast<std::uint32_t>(session_.window.y)));
      session_.notice = "saved " + file.string();
    } catch (const Error& error) {
      session_.error = error.what();
    }
  }

  Session& session_;
  ViewerOptions options_;
  Window window_;
  gpu::Instance instance_;
  gpu::Surface surface_;
  gpu::Device device_;
  gpu::Presenter presenter_;
  render::Renderer renderer_;
  render::GpuMesh mesh_;
  std::optional<render::SceneTarget> target_;
  std::unique_ptr<Overlay> overlay_;
  Panels panels_;
  Gestures gestures_;
  EditRunner edits_;
  ArrivalRunner arrivals_;
  StateLog log_;
  std::unique_ptr<LoadJob> load_;
  std::unique_ptr<JobOf<Saved>> save_;
  std::optional<Drawn> drawn_;
  std::optional<render::Settings> drawable_settings_;  ///< those that the mirror was made for
  std::optional<render::Settings> drawn_settings_;     ///< the same, with what is shown of splits
  std::optional<std::uint64_t> uploaded_revision_;     ///< of the edits that the mirror has
  render::UploadStats upload_;
  Pointer pointer_;
  std::string title_;
  std::uint64_t mesh_generation_ = 0;
  std::uint64_t framebuffers_of_ = 0;
  double frame_ms_ = 0.0;
  int frames_wanted_ = kFramesAfterEvent;
  bool is_hover_old_ = false;
  bool is_moving_ = false;
  bool has_changed_ = false;  ///< the frame before showed something new
  bool is_hurried_ = false;   ///< it was drawn without smooth edges
  double moved_at_s_ = 0.0;
};

}  // namespace

void run_viewer(Session& session, const std::vector<KeyPress>& keys, const ViewerOptions& options,
                std::unique_ptr<PmArrival>& arrival) {
  Viewer(session, options, arrival).run(keys);
}

}  // namespace mesher::app
