#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <string>
#include <variant>

#include "app/files/picture_requests.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/ui/style.h"
#include "engine/core/text.h"

namespace mesher::app {
namespace {

constexpr float kPictureWidthPoints = 720.0F;
// Of the rows of options, besides the rest of the dialog.
constexpr float kOptionsPoints = 140.0F;
// Of those of a turntable.
constexpr float kTurnPoints = 54.0F;

std::string size_text(const View& view, std::uint32_t scale) {
  const auto pixels = [&](double side) {
    return count_text(std::lround(side) * std::int64_t{scale});
  };
  return fmt::format("{} x {} pixels", pixels(view.size().x), pixels(view.size().y));
}

/// A check box beside the one before it, or below it where the dialog ends. `is_first`: there is
/// none. Returns whether it was clicked.
bool check_box(const char* name, bool& value, const std::string& help, bool is_first = false) {
  const float width = ImGui::GetFrameHeight() + ImGui::CalcTextSize(name).x + units(24.0F);
  const float room =
      ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x - ImGui::GetItemRectMax().x;
  if (!is_first && width < room) ImGui::SameLine(0.0F, units(16.0F));
  const bool is_clicked = ImGui::Checkbox(name, &value);
  note_widget(name);
  tooltip(help.c_str());
  return is_clicked;
}

void draw_switches(PictureDialog& dialog) {
  bool is_first = true;
  for (const Option<PictureOptions>& option : kPictureOptions) {
    const auto* member = std::get_if<bool PictureOptions::*>(&option.member);
    if (member == nullptr) continue;
    check_box(option.label, dialog.options.*(*member),
              std::string(option.help) + "\n" + command_line_name(option), is_first);
    is_first = false;
  }
  check_box("lines", dialog.options.has_lines, "draw edges, creases and boundaries as shown");
  bool is_turn = dialog.is_turn;
  if (check_box("turntable", is_turn,
                "a full turn around the model: an animated WebP or, with a name such as "
                "turn_###.png, one PNG per frame\n--turntable"))
    choose_turn(dialog, is_turn);
}

void draw_options(PictureDialog& dialog, const View& view) {
  for (const Option<PictureOptions>& option : kPictureOptions) {
    if (!std::holds_alternative<bool PictureOptions::*>(option.member))
      edit_option(option, dialog.options);
  }
  draw_switches(dialog);
  if (dialog.is_turn) edit_options(kTurntableOptions, dialog.turn);
  faint_text(size_text(view, dialog.options.scale));
}

}  // namespace

void draw_picture_dialog(Session& session, Ui& ui) {
  PictureDialog& dialog = session.picture;
  if (begin_dialog("Save a picture", &dialog.is_shown, kPictureWidthPoints)) {
    const float rest = kOptionsPoints + (dialog.is_turn ? kTurnPoints : 0.0F);
    const auto shown = draw_browser(dialog.browser, session, ui.picture_list, rest, ui);
    draw_options(dialog, session.view);
    const bool overwrites = !dialog.asked.empty() && !dialog.browser.problem.empty();
    if (wide_button(overwrites ? "Overwrite###save" : "Save###save", true, "Enter") || ui.submits)
      submit_picture(session, shown);
  }
  end_dialog(ui.areas);
}

}  // namespace mesher::app
