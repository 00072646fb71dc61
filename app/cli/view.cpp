#include "app/cli/view.h"

#include <filesystem>
#include <iostream>
#include <vector>

#include "app/cli/batch.h"
#include "app/document/json.h"
#include "app/edit/edits.h"
#include "app/files/journal.h"
#include "app/files/paths.h"
#include "app/files/pm_arrival.h"
#include "app/input/commands.h"
#include "app/input/keys.h"
#include "app/viewer/scripted_session.h"
#include "app/viewer/state_log.h"
#include "app/viewer/viewer.h"
#include "app/viewer/window.h"
#include "engine/io/pm_file.h"
#include "engine/io/png.h"

namespace mesher::app {
namespace {

// Longer waits would be felt.
constexpr double kMomentSeconds = 0.2;

void print_state(const Session& session, const std::string& output) {
  Json json = to_json(session);
  if (!output.empty()) json["output"] = output;
  std::cout << to_text(json) << '\n';
}

/// Presses the keys without a window and returns the picture.
Image scripted_picture(Session& session, const std::vector<KeyPress>& keys, const LookOptions& look,
                       const ViewOptions& view) {
  StateLog log(view.state_log);
  ScriptedSession script(session, {.device = look.device,
                                   .validation = look.validation,
                                   .panels = view.panels,
                                   .ui_scale = view.ui_scale > 0.0F ? view.ui_scale : 1.0F});
  log.note(session);
  for (const KeyPress& key : keys) {
    script.press({&key, 1});
    log.note(session);
    if (session.wants_quit) break;
  }
  Image picture = script.picture();
  script.expect_no_messages();
  return picture;
}

// `mesher simplfy` is a mistyped command, not a model of that name.
void refuse_mistyped_command(const std::string& model, const std::string& nearest) {
  const std::filesystem::path file = find_model(model);
  std::error_code ignored;
  if (file.has_extension() || file.has_parent_path() || std::filesystem::exists(file, ignored)) {
    return;
  }
  const std::string hint = nearest.empty() ? "see mesher --help" : "did you mean " + nearest + "?";
  throw UsageError("'" + model + "' is neither a command nor a model (" + hint + ")");
}

// Called before the model is read, so that a typing error is reported at once.
std::vector<KeyPress> checked_keys(const std::string& text) {
  std::vector<KeyPress> keys = parse_keys(text);
  for (const KeyPress& key : keys) {
    if (command_for(key) == nullptr)
      throw UsageError("--keys: '" + to_text(key) + "' is not bound to a command");
  }
  return keys;
}

/// The size of the window or picture, in pixels. That of a window without --size is known later.
glm::dvec2 window_size(const LookOptions& look, float scale) {
  if (look.size.empty()) return default_window_size(scale, {});
  const Size size = parse_size(look.size);
  return {size.width, size.height};
}

/// Loads the rest. Prints what is damaged, as there is no window that shows it, or refuses it.
void finish(Session& session, PmArrival& arrival, bool allows_damaged) {
  arrival.finish(session);
  const std::string& damage = session.document.error;
  if (!damage.empty() && !allows_damaged)
    throw InputError(damage + "; --allow-damaged uses the intact part");
  if (!damage.empty()) say("DAMAGED: " + damage);
  run_waiting_edits(session.document);
}

LoadOptions load_options(const InputOptions& input) {
  return {.read = read_options(input), .tag_creases_deg = input.tag_creases_deg};
}

void show(Session& session, LoadedModel&& loaded) {
  show_model(session, std::move(loaded.model), loaded.statistics, loaded.file);
  session.document.source = loaded.source;
  session.document.stand_in = loaded.stand_in;
}

/// Shows a model.
void open_model(Session& session, const InputOptions& input, const CommonOptions& common) {
  LoadedModel loaded = load(input, common);
  loaded.source = {.stamp = stamp_of(loaded.file),
                   .crease_index_base = input.crease_index_base,
                   .keep_isolated_vertices = input.keep_isolated,
                   .weld = read_options(input).weld,
                   .tag_creases_deg = input.tag_creases_deg};
  show(session, std::move(loaded));
}

/// Begins to load a progressive mesh.
std::unique_ptr<PmArrival> start_arrival(const InputOptions& input) {
  if (input.tag_creases_deg) {
    throw UsageError(
        "--tag-creases: cannot be used with a progressive mesh, which keeps the creases of the "
        "model that it was built from");
  }
  return std::make_unique<PmArrival>(find_model(input.model));
}

/// Begins to open the model of a window, and waits a moment, so that a small model is in the first
/// picture and a damaged one is an error of the command. Returns what is still to be loaded.
RestOfModel begin_to_open(Session& session, const InputOptions& input,
                          const CommonOptions& common) {
  RestOfModel rest;
  const std::filesystem::path file = find_model(input.model);
  if (io::is_pm_file(file)) {
    rest.arrival = start_arrival(input);
    rest.arrival->wait_for_base(session, kMomentSeconds);
    return rest;
  }
  rest.load = std::make_unique<LoadJob>(file, load_options(input), nullptr);
  if (!rest.load->wait_for(kMomentSeconds)) return rest;
  LoadedModel loaded = rest.load->take();
  rest.load.reset();
  if (!common.quiet) say_findings(loaded.model);
  show(session, std::move(loaded));
  return rest;
}

/// The other models of the command line. Throws InputError for one that is not there, because a
/// misspelled name is better told before the window opens.
std::vector<std::filesystem::path> more_models(const ViewOptions& view) {
  std::vector<std::filesystem::path> files;
  for (const std::string& name : view.more) {
    files.push_back(find_model(name));
    std::error_code ignored;
    if (!std::filesystem::exists(files.back(), ignored))
      throw InputError(files.back().string(), 0, "does not exist");
  }
  return files;
}

/// Loads what is still to be loaded.
void finish(Session& session, RestOfModel& rest) {
  if (rest.arrival) finish(session, *rest.arrival, true);
  if (!rest.load) return;
  rest.load->wait();
  show(session, rest.load->take());
}

}  // namespace

void open_whole(Session& session, const InputOptions& input, const CommonOptions& common) {
  if (!io::is_pm_file(find_model(input.model))) return open_model(session, input, common);
  finish(session, *start_arrival(input), input.allow_damaged);
}

void run_view(const InputOptions& input, const LookOptions& look, const ViewOptions& view,
              const CommonOptions& common) {
  const float scale = view.ui_scale > 0.0F ? view.ui_scale : 1.0F;
  const glm::dvec2 window = window_size(look, scale);
  const std::vector<KeyPress> keys = checked_keys(view.keys);
  if (!look.camera.empty()) parse_camera(look.camera);
  if (!view.screenshot.empty() && !is_png_name(view.screenshot)) {
    throw UsageError("--screenshot: '" + view.screenshot + "' does not end in .png");
  }
  refuse_mistyped_command(input.model, view.nearest_command);
  if (!view.screenshot.empty() && !view.more.empty())
    throw UsageError("--screenshot: shows one model, and not also '" + view.more.front() + "'");
  Session session;
  InputOptions shown = input;
  shown.allow_damaged = true;  // what is sound is shown
  shown.keeps_scene = true;
  session.wants_open = more_models(view);
  session.view.window = window;
  // Keys act on the whole model, and the sample is small.
  const bool is_whole = !view.screenshot.empty() || !keys.empty() || view.is_sample;
  RestOfModel rest;
  if (is_whole) {
    open_whole(session, shown, common);
  } else {
    rest = begin_to_open(session, input, common);
  }
  const auto frame = [&look](Session& framed) {
    const Box& box = framed.document.statistics.box;
    apply_look(framed.view, box, look);
    if (look.camera.empty() && look.view.empty()) frame_from_default_view(framed.view, box);
  };
  frame(session);
  session.shows_info = fits_docks(session.view.window, scale);
  if (view.is_sample) session.sample = session.document.opening;
  session.shows_start = view.is_sample && view.screenshot.empty() && keys.empty();
  std::string output = view.screenshot;
  if (!output.empty()) {
    io::write_png(output, scripted_picture(session, keys, look, view), io::Flush::now);
  } else {
    try {
      run_viewer(session, keys,
                 {.device = look.device,
                  .validation = look.validation,
                  .ui_scale = view.ui_scale,
                  .is_sized = !look.size.empty(),
                  .state_log = view.state_log,
                  .turn_log = view.turn_log,
                  .state_folder = state_folder(),
                  .config_folder = config_folder(),
                  .frame_first = frame,
                  .read = read_options(input)},
                 rest);
    } catch (const NoDisplay& no_display) {
      finish(session, rest);
      frame(session);
      const Image picture = scripted_picture(session, keys, look, view);
      output = free_picture_name("", session.document.file.stem().string()).string();
      io::write_png(output, picture, io::Flush::now);
      say(std::string(no_display.what()) + "; wrote a picture instead: " + output);
    }
  }
  if (common.json) print_state(session, output);
}

}  // namespace mesher::app
