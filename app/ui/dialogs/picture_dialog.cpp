#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

#include "app/files/picture_requests.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

constexpr float kPictureWidthPoints = 720.0F;
// Of the rows of options, besides the rest of the dialog.
constexpr float kOptionsPoints = 190.0F;

std::string size_text(const View& view, std::uint32_t scale) {
  const auto pixels = [&](double side) {
    return count_text(std::lround(side) * std::int64_t{scale});
  };
  return fmt::format("{} x {} pixels", pixels(view.size().x), pixels(view.size().y));
}

void draw_options(PictureDialog& dialog, const View& view) {
  edit_options(kPictureOptions, dialog.options);
  edit_switch("lines", dialog.options.has_lines, "draw edges, creases and boundaries as shown");
  bool is_turn = dialog.is_turn;
  if (edit_switch("turntable", is_turn,
                  "a full turn around the model: an animated WebP or, with a name such as "
                  "turn_###.png, one PNG per frame"))
    choose_turn(dialog, is_turn);
  if (dialog.is_turn) edit_options(kTurntableOptions, dialog.turn);
  faint_text(size_text(view, dialog.options.scale));
}

}  // namespace

void draw_picture_dialog(Session& session, Ui& ui) {
  PictureDialog& dialog = session.picture;
  if (begin_dialog("Save a picture", &dialog.is_shown, kPictureWidthPoints)) {
    const auto shown = draw_browser(dialog.browser, session, ui.picture_list, kOptionsPoints, ui);
    draw_options(dialog, session.view);
    const bool overwrites = !dialog.asked.empty() && !dialog.browser.problem.empty();
    if (wide_button(overwrites ? "Overwrite###save" : "Save###save", true, "Enter") || ui.submits)
      submit_picture(session, shown);
  }
  end_dialog(ui.areas);
}

}  // namespace mesher::app
