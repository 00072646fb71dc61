#include "app/viewer/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "app/document/shown.h"
#include "app/edit/crease_edits.h"
#include "app/files/journal.h"
#include "app/files/leave.h"
#include "app/files/paths.h"
#include "app/files/preferences_file.h"
#include "app/input/commands.h"
#include "app/input/gestures.h"
#include "app/ui/panels.h"
#include "app/viewer/background_work.h"
#include "app/viewer/desktop_files.h"
#include "app/viewer/edit_keeper.h"
#include "app/viewer/graphics.h"
#include "app/viewer/recovery.h"
#include "app/viewer/state_log.h"
#include "app/viewer/turn_log.h"
#include "app/viewer/window.h"
#include "engine/core/text.h"
#include "engine/gpu/result.h"
#include "engine/io/png.h"
#include "engine/render/offscreen.h"

namespace mesher::app {
namespace {

constexpr double kJobPollSeconds = 0.1;
constexpr double kCaretBlinkSeconds = 0.4;
// The longest time step of an animation, so that a long frame does not make it jump.
constexpr double kLongestStepSeconds = 0.1;
// ImGui settles its layout within a few frames of an event.
constexpr int kFramesAfterEvent = 3;

/// The window: turns events into commands and gestures, and draws a frame when something changed.
class Viewer {
 public:
  Viewer(Session& session, const ViewerOptions& options, RestOfModel& rest)
      : session_(session),
        ui_scale_(options.ui_scale),
        window_(options.is_sized ? glm::ivec2(session.view.window) : glm::ivec2(0),
                options.ui_scale, "mesher"),
        graphics_(window_, options.device, options.validation),
        gestures_(session.document, session.view),
        work_(
            session, options.read, {options.device, options.validation},
            [this](LoadedModel&& loaded) { recovery_.show(std::move(loaded)); }, Window::wake),
        recovery_(session, graphics_, work_, options.frame_first),
        desktop_files_(session, Window::wake),
        log_(options.state_log),
        turn_(options.turn_log),
        keeper_(options.state_folder),
        preferences_file_(options.config_folder) {
    window_.set_events(events());
    scale_ = wanted_scale();
    graphics_.open_overlay(scale_);
    // The monitor's scale and the size of the window are known only now.
    if (!options.is_sized)
      resize(session.view, session.document.statistics.box, window_.framebuffer_size(), {});
    session.shows_info = session.shows_info && fits_docks(session.view.window, scale_);
    session.preferences = preferences_file_.read();
    if (session.sample == 0 && session.document.opening > 0)
      remember_opened(session.preferences, session.document.file);
    work_.take_over(std::move(rest.arrival));
    work_.take_over(std::move(rest.load));
  }

  void run(const std::vector<KeyPress>& keys) {
    try {
      update_scene();
      press(keys);
      keeper_.look_for_lost_edits(Window::wake);
      while (!may_end())
        step();
    } catch (const GraphicsFailed& failure) {
      const bool is_kept = keep_everything();
      throw DeviceError(std::string(failure.what()) +
                        (is_kept ? "; mesher offers the unsaved edits when it starts again" : ""));
    } catch (...) {
      keep_everything();
      throw;
    }
    keeper_.forget();
    graphics_.finish();
  }

 private:
  void step() {
    wait();
    turn_.begin();
    if (window_.take_close_request()) leave(Leaving::quit);
    if (work_.advance()) want_frames();
    if (desktop_files_.advance()) want_frames();
    serve_requests();
    if (keeper_.take_lost_edits(session_)) want_frames();
    keep_journals();
    keep_preferences();
    animate();
    update_hover();
    const bool drew = frames_wanted_ > 0 && draw();
    if (session_.wants_screenshot) save_screenshot();
    if (session_.copied) overlay().copy(*std::exchange(session_.copied, std::nullopt));
    turn_.end(drew, work_.visible_job());
    log_.note(session_, &pointer_, &panels_.widgets());
  }

  /// A file that is being written is finished first, while the window shows its progress. If that
  /// fails or is canceled, the window stays.
  bool may_end() {
    if (session_.wants_quit && work_.is_writing()) {
      session_.wants_quit = false;
      if (!std::exchange(quits_once_written_, true)) work_.take_write_failure();
      session_.document.notice = "mesher ends when the file is written; Esc cancels writing it";
      want_frames();
    } else if (quits_once_written_ && !work_.is_writing()) {
      quits_once_written_ = false;
      // This asks if there were edits meanwhile.
      if (!work_.take_write_failure()) leave(Leaving::quit);
    }
    return session_.wants_quit;
  }

  /// Called when an error ends the program. Returns whether edits are kept for the next start.
  bool keep_everything() {
    keep_journals();
    try {
      work_.finish_saves();
    } catch (const std::exception&) {
      // The error that ends the program is reported. The journals have the edits.
    }
    return keeper_.has_edits();
  }

  // As in a script, each key acts on the result of the keys before it.
  void press(const std::vector<KeyPress>& keys) {
    if (!keys.empty()) work_.finish_arrival();
    work_.finish_edits();
    for (const KeyPress& key : keys) {
      press_key(key);
      work_.finish_edits();
      session_.document.progressive.settle(shown_pixels_per_unit(session_.document, session_.view));
      update_scene();
      if (session_.wants_screenshot) save_screenshot();
      if (session_.wants_quit) break;
    }
  }

  Window::Events events() {
    return {.key =
                [this](const KeyPress& key) {
                  turn_.begin();
                  press_key(key);
                },
            .press =
                [this](MouseButton button, Modifiers modifiers, glm::dvec2 at) {
                  turn_.begin();
                  pointer_.is_pressed = true;
                  if (!panels_.covers(at)) gestures_.press(button, modifiers, at, Window::time());
                  want_frames();
                },
            .release =
                [this] {
                  turn_.begin();
                  pointer_.is_pressed = false;
                  session_.wants_context_menu = gestures_.release();
                  want_frames();
                },
            .move =
                [this](glm::dvec2 at) {
                  turn_.begin();
                  move(at);
                },
            .scroll =
                [this](double steps) {
                  turn_.begin();
                  if (!panels_.covers(pointer_.at)) gestures_.scroll(steps, pointer_.at);
                  want_frames();
                },
            .drop =
                [this](const std::vector<std::filesystem::path>& files) {
                  work_.open(files);
                  want_frames();
                },
            .changed =
                [this] {
                  turn_.begin();
                  want_frames();
                }};
  }

  void leave(Leaving leaving) {
    request_leave(session_, leaving);
    want_frames();
  }

  void serve_requests() {
    if (!session_.wants_open.empty()) work_.open(std::exchange(session_.wants_open, {}));
    for (LostEdits& lost : std::exchange(session_.wants_restore, {}))
      work_.restore(std::move(lost));
  }

  void keep_journals() {
    const EditKeeper::Remarks remarks = keeper_.keep(session_);
    say(remarks.notice);
    complain(remarks.problem);
  }

  void keep_preferences() {
    preferences_file_.write(session_.preferences);
    say(preferences_file_.take_remark());
  }

  void complain(const std::string& remark) {
    if (remark.empty()) return;
    std::string& error = session_.document.error;
    error += (error.empty() ? "" : "\n") + remark;
    want_frames();
  }

  void say(const std::string& remark) {
    if (remark.empty()) return;
    session_.document.notice = remark;
    want_frames();
  }

  // A change of the picture may also change the edge under the cursor.
  void want_frames() {
    frames_wanted_ = kFramesAfterEvent;
    is_hover_outdated_ = true;
  }

  // A move without a drag, outside the panels, only changes the edge under the cursor.
  void move(const glm::dvec2& at) {
    const bool touches_panel = panels_.covers(at) || panels_.covers(pointer_.at);
    pointer_.at = at;
    is_hover_outdated_ = true;
    if (gestures_.move(at) || touches_panel) want_frames();
  }

  // Called once per frame instead of once per move, because it visits every face.
  void update_hover() {
    if (!is_hover_outdated_ || !session_.document.creases.is_on) return;
    const bool is_over_model = !gestures_.is_dragging() && !panels_.covers(pointer_.at);
    if (hover_edge(session_.document, session_.view,
                   is_over_model ? std::optional(pointer_.at) : std::nullopt))
      want_frames();
    is_hover_outdated_ = false;
  }

  void press_key(const KeyPress& key) {
    want_frames();
    if (has_question(session_)) return answer_question(session_, key);
    // A dialog takes the keyboard at once; its text field takes it only after it was drawn.
    const bool is_typing = has_dialog() || overlay().wants_text();
    if (session_.shows_help && (key.name == "f1" || (key.name == "/" && key.shift))) {
      session_.shows_help = false;
      return follow_dialogs();
    }
    if (key.name == "escape") {
      if (overlay().close_popups()) return;
      // A dialog is closed first, unless it waits for the job.
      const bool may_cancel = !has_dialog() || !session_.open_dialog.opening.empty();
      if (may_cancel && work_.cancel()) return;
      if (is_typing && !has_dialog()) return;  // ImGui takes the focus from the text field
    } else if (is_typing) {
      // ImGui polls keys once per frame, and misses a key that was released before.
      if (key.name == "enter" && has_dialog()) panels_.submit_dialog();
      if (key.name == "down") panels_.move_row(1);
      if (key.name == "up") panels_.move_row(-1);
      if (key.name == "tab") complete_typed_path();
      return;
    }
    if (overlay().takes_key(key.name)) {
      if (key.name == "enter") overlay().press_focused();
      return;
    }
    if (const Command* command = command_for(key)) {
      overlay().ignore_key(key.name);
      app::run(session_, *command);
    }
    follow_dialogs();
  }

  bool has_dialog() const {
    return session_.open_dialog.is_shown || session_.saving.shows_dialog ||
           session_.picture.is_shown || session_.shows_palette || session_.shows_help;
  }

  void complete_typed_path() {
    session_.open_dialog.browser.wants_completion = session_.open_dialog.is_shown;
    session_.saving.browser.wants_completion = session_.saving.shows_dialog;
    session_.picture.browser.wants_completion = session_.picture.is_shown;
  }

  // The keys after a dialog was closed are commands again, even before the next frame.
  void follow_dialogs() {
    const bool is_open = has_dialog() || session_.shows_help || has_question(session_);
    if (had_dialog_ && !is_open) overlay().release_keyboard();
    had_dialog_ = is_open;
  }

  /// Advances the animation by the time since the last frame, if there was an animation then.
  void animate() {
    const double now = Window::time();
    const double step = is_moving_ ? std::min(now - moved_at_s_, kLongestStepSeconds) : 0.0;
    moved_at_s_ = now;
    is_moving_ = session_.document.progressive.advance(
        step, shown_pixels_per_unit(session_.document, session_.view));
    if (advance_animation(session_.document, step)) is_moving_ = true;
    if (is_moving_) want_frames();
  }

  void wait() {
    if (frames_wanted_ > 0 || work_.has_news()) return Window::poll_events();
    if (work_.visible_job() != nullptr) {
      want_frames();  // the progress bar
      return Window::wait_events(kJobPollSeconds);
    }
    if (overlay().wants_text()) {
      want_frames();  // the caret
      return Window::wait_events(kCaretBlinkSeconds);
    }
    if (work_.is_arriving()) return Window::wait_events(kJobPollSeconds);
    Window::wait_events(keeper_.is_failing() ? Journal::kRetrySeconds : -1.0);
  }

  /// Updates the GPU's copy of the model before a frame begins. Returns false if the GPU could not
  /// hold a change, which is then reverted: draw in the next frame.
  bool update_scene() {
    const Recovery::Outcome outcome = recovery_.update();
    if (outcome != Recovery::Outcome::unchanged) painter().invalidate();
    drawable_settings_ = session_.view.settings;
    if (outcome == Recovery::Outcome::reverted) want_frames();
    return outcome != Recovery::Outcome::reverted;
  }

  float wanted_scale() const { return ui_scale_ > 0.0F ? ui_scale_ : window_.content_scale(); }

  /// The scale changes when the window is moved to another monitor, or the desktop's settings
  /// change.
  void follow_scale() {
    if (scale_ == wanted_scale()) return;
    scale_ = wanted_scale();
    overlay().set_scale(scale_);
    want_frames();
  }

  /// Draws a frame. If the graphics fail, they are restarted, and another frame is drawn. Returns
  /// whether there was something to draw into.
  bool draw() {
    try {
      return draw_frame();
    } catch (const gpu::LostError& lost) {
      restart_graphics(lost);
    } catch (const gpu::OutOfMemoryError& failure) {
      restart_graphics(failure);
    }
    return false;
  }

  void restart_graphics(const DeviceError& failure) {
    recovery_.restart(failure);
    want_frames();
  }

  bool draw_frame() {
    --frames_wanted_;
    follow_scale();
    const double start = Window::time();
    if (!update_scene()) return false;
    const glm::uvec2 size = window_.framebuffer_size();
    turn_.begin_wait();
    auto frame = graphics_.presenter().begin({size.x, size.y});
    turn_.end_wait();
    if (!frame) return false;
    draw_panels(frame->extent);
    const VkRect2D place = model_rectangle(session_.view, frame->extent);
    draw_scene(*frame, place.extent);
    painter().image().copy_to(frame->commands, frame->image, place.offset);
    overlay().draw(frame->commands, frame->view, frame->extent);
    graphics_.presenter().submit(*frame);
    turn_.begin_wait();
    if (!graphics_.presenter().present(*frame)) want_frames();
    turn_.end_wait();
    graphics_.note_frame();
    frame_ms_ = 1000.0 * (Window::time() - start);
    update_title();
    return true;
  }

  void draw_panels(const VkExtent2D& extent) {
    const std::uint64_t generation = graphics_.presenter().generation();
    if (generation != framebuffers_of_) overlay().forget_images();
    framebuffers_of_ = generation;
    const glm::dvec2 window{extent.width, extent.height};
    overlay().begin(window);
    const PanelActions actions = panels_.draw(session_, {.window = window,
                                                         .job = work_.visible_job(),
                                                         .can_cancel = work_.can_cancel(),
                                                         .upload = graphics_.mirror().last_upload(),
                                                         .frame_ms = frame_ms_,
                                                         .device = graphics_.device().name()});
    overlay().end();
    if (overlay().require_glyphs(panels_.code_points())) want_frames();
    follow_dialogs();
    if (actions.cancels_job) work_.cancel();
    if (actions.wants_frames || !session_.document.edits.waiting.empty()) want_frames();
  }

  void draw_scene(const gpu::Frame& frame, const VkExtent2D& extent) {
    if (painter().draw(frame.commands, extent, graphics_.mirror(), session_.document,
                       session_.view.camera, Window::time()))
      want_frames();
    session_.view.is_finished = painter().is_finished();
    // If panels have just changed the settings, the mirror is updated before the next frame.
    if (session_.view.settings != drawable_settings_) want_frames();
  }

  void update_title() {
    const std::string title =
        fmt::format("{}{} - {} - mesher", has_unsaved_edits(session_.document) ? "*" : "",
                    session_.document.model.name,
                    count_text(shown_mesh(session_.document).face_count(), "face"));
    if (title != title_) window_.set_title(title);
    title_ = title;
  }

  void save_screenshot() {
    session_.wants_screenshot = false;
    want_frames();
    if (!update_scene()) return;
    const std::filesystem::path file = next_screenshot(session_.document.model.name);
    try {
      io::write_png(file, render::render_image(graphics_.device(), painter().renderer(),
                                               graphics_.mirror().mesh(), session_.view.camera,
                                               graphics_.mirror().settings(),
                                               static_cast<std::uint32_t>(session_.view.window.x),
                                               static_cast<std::uint32_t>(session_.view.window.y)));
      session_.document.notice = "saved " + file.string();
    } catch (const gpu::LostError& lost) {
      restart_graphics(lost);
      session_.wants_screenshot = true;
    } catch (const Error& error) {
      session_.document.error = error.what();
    }
  }

  ScenePainter& painter() { return graphics_.painter(); }
  Overlay& overlay() { return graphics_.overlay(); }

  Session& session_;
  float ui_scale_;  ///< that was asked for; 0: that of the monitor
  Window window_;
  Graphics graphics_;
  float scale_ = 1.0F;  ///< of the panels
  Panels panels_;
  Gestures gestures_;
  BackgroundWork work_;
  Recovery recovery_;
  DesktopFiles desktop_files_;
  StateLog log_;
  TurnLog turn_;
  EditKeeper keeper_;
  PreferencesFile preferences_file_;
  bool quits_once_written_ = false;
  render::Settings drawable_settings_;  ///< of the session when the mirror was last updated
  Pointer pointer_;
  std::string title_;
  std::uint64_t framebuffers_of_ = 0;  ///< generation of the presenter that the overlay knows
  double frame_ms_ = 0.0;
  int frames_wanted_ = kFramesAfterEvent;
  bool is_hover_outdated_ = false;
  bool had_dialog_ = false;
  bool is_moving_ = false;
  double moved_at_s_ = 0.0;
};

}  // namespace

void run_viewer(Session& session, const std::vector<KeyPress>& keys, const ViewerOptions& options,
                RestOfModel& rest) {
  Viewer(session, options, rest).run(keys);
}

}  // namespace mesher::app
