#include <fmt/format.h>
#include <imgui.h>

#include "app/files/open.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "engine/io/format.h"

namespace mesher::app {
namespace {

constexpr float kOpenWidthPoints = 720.0F;
// Of the button, the progress bar and the list of formats.
constexpr float kRestPoints = 70.0F;

}  // namespace

void draw_open_dialog(Session& session, Ui& ui) {
  OpenDialog& dialog = session.open_dialog;
  if (begin_dialog("Open a model", &dialog.is_shown, kOpenWidthPoints)) {
    const auto shown = draw_browser(dialog.browser, session, ui.open_list, kRestPoints, ui);
    const bool is_reading = !dialog.opening.empty();
    const bool submits = wide_button(is_reading ? "Opening...###open" : "Open###open", !is_reading,
                                     "Enter opens, Tab completes, the arrow keys choose") ||
                         ui.submits;
    if (submits) submit_open(session, shown);
    if (is_reading && ui.facts.job != nullptr)
      ImGui::ProgressBar(ui.facts.job->progress().fraction(), {-FLT_MIN, 0.0F});
    faint_text("Formats: " + io::readable_formats());
  }
  end_dialog(ui.areas);
  if (!dialog.is_shown) dialog.opening.clear();
}

}  // namespace mesher::app
