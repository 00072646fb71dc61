#include "app/cli/view.h"

#include <iostream>

#include "app/cli/batch.h"
#include "app/json.h"
#include "app/keys.h"
#include "app/paths.h"
#include "app/scripted_session.h"
#include "app/viewer.h"
#include "app/window.h"
#include "engine/io/png.h"

namespace mesher::app {
namespace {

constexpr std::uint32_t kPanelFitsWidth = 700;

void picture_without_window(Session& session, const std::vector<KeyPress>& keys,
                            const std::string& output, const LookOptions& look, bool panels,
                            const CommonOptions& common) {
  ScriptedSession script(session,
                         {.device = look.device, .validation = look.validation, .panels = panels});
  script.press(keys);
  write_png(output, script.picture());
  script.expect_no_messages();
  if (common.json) {
    Json json = to_json(session);
    json["output"] = output;
    std::cout << json.dump(2) << '\n';
  }
}

}  // namespace

void run_view(const InputOptions& input, const LookOptions& look, const ViewOptions& view,
              const CommonOptions& common) {
  const Size size = parse_size(look.size.empty() ? "1280x800" : look.size);
  const std::vector<KeyPress> keys = parse_keys(view.keys);
  if (!look.camera.empty()) parse_camera(look.camera);
  LoadedModel loaded = load(input, common);
  Session session;
  session.window = {size.width, size.height};
  show_model(session, std::move(loaded.model), loaded.statistics, loaded.file);
  apply_look(session, look);
  // On a small window the panel would hide the model.
  session.shows_info = size.width >= kPanelFitsWidth;
  if (!session.shows_info) session.notice = "F1: keys   Tab: panel";
  if (!view.screenshot.empty()) {
    return picture_without_window(session, keys, view.screenshot, look, view.panels, common);
  }
  try {
    run_viewer(session, keys,
               {.device = look.device,
                .validation = look.validation,
                .state_log = view.state_log,
                .read = {.crease_index_base = input.crease_index_base,
                         .keep_isolated_vertices = input.keep_isolated}});
  } catch (const NoDisplay& no_display) {
    const std::string output = loaded.file.stem().string() + ".png";
    std::cerr << "mesher: " << no_display.what() << "; drawing a picture instead: " << output
              << '\n';
    picture_without_window(session, keys, output, look, view.panels, common);
  }
}

}  // namespace mesher::app
