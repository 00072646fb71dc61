#include "app/cli/view.h"

#include <iostream>

#include "app/cli/batch.h"
#include "app/commands.h"
#include "app/json.h"
#include "app/keys.h"
#include "app/paths.h"
#include "app/scripted_session.h"
#include "app/state_log.h"
#include "app/viewer.h"
#include "app/window.h"
#include "engine/io/png.h"

namespace mesher::app {
namespace {

constexpr std::uint32_t kPanelFitsWidth = 700;

void print_state(const Session& session, const std::string& output) {
  Json json = to_json(session);
  if (!output.empty()) json["output"] = output;
  std::cout << to_text(json) << '\n';
}

/// A script's picture: keys pressed, no window.
Image scripted_picture(Session& session, const std::vector<KeyPress>& keys, const LookOptions& look,
                       const ViewOptions& view) {
  StateLog log(view.state_log);
  ScriptedSession script(
      session, {.device = look.device, .validation = look.validation, .panels = view.panels});
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

// `mesher simplfy` means a command, not a file of that name.
void refuse_mistyped_command(const std::string& model) {
  const std::filesystem::path file = find_model(model);
  std::error_code ignored;
  if (file.has_extension() || file.has_parent_path() || std::filesystem::exists(file, ignored)) {
    return;
  }
  throw UsageError("'" + model + "' is neither a command nor a model (see mesher --help)");
}

// Before the model is read: a wrong word should not cost the time that a large file takes.
std::vector<KeyPress> checked_keys(const std::string& text) {
  std::vector<KeyPress> keys = parse_keys(text);
  for (const KeyPress& key : keys) {
    if (!command_for(key)) throw UsageError("--keys: '" + to_text(key) + "' does nothing");
  }
  return keys;
}

}  // namespace

void run_view(const InputOptions& input, const LookOptions& look, const ViewOptions& view,
              const CommonOptions& common) {
  const Size size = parse_size(look.size.empty() ? "1280x800" : look.size);
  const std::vector<KeyPress> keys = checked_keys(view.keys);
  if (!look.camera.empty()) parse_camera(look.camera);
  if (!view.screenshot.empty() && !is_png_name(view.screenshot)) {
    throw UsageError("--screenshot: '" + view.screenshot + "' does not end in .png");
  }
  refuse_mistyped_command(input.model);
  LoadedModel loaded = load(input, common);
  Session session;
  session.window = {size.width, size.height};
  show_model(session, std::move(loaded.model), loaded.statistics, loaded.file);
  apply_look(session, look);
  // On a small window the panel would hide the model.
  session.shows_info = size.width >= kPanelFitsWidth;
  if (!session.shows_info) session.notice = "F1: keys   Tab: panel";
  std::string output = view.screenshot;
  if (!output.empty()) {
    write_png(output, scripted_picture(session, keys, look, view));
  } else {
    try {
      run_viewer(session, keys,
                 {.device = look.device,
                  .validation = look.validation,
                  .state_log = view.state_log,
                  .read = {.crease_index_base = input.crease_index_base,
                           .keep_isolated_vertices = input.keep_isolated}});
    } catch (const NoDisplay& no_display) {
      const Image picture = scripted_picture(session, keys, look, view);
      output = free_picture_name("", loaded.file.stem().string()).string();
      write_png(output, picture);
      std::cerr << "mesher: " << no_display.what() << "; drew a picture instead: " << output
                << '\n';
    }
  }
  if (common.json) print_state(session, output);
}

}  // namespace mesher::app
