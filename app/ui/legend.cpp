#include "app/document/legend.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/document/shown.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/ui/style.h"

namespace mesher::app {
namespace {

constexpr float kMarginPoints = 8.0F;

ImU32 color_of(const render::Color& color, float opacity) {
  return ImGui::GetColorU32(ImVec4(color.x, color.y, color.z, opacity));
}

Legend shown_legend(const Session& session) {
  const bool is_hidden =
      !session.view.shows_legend || session.panel_covers_model || session.document.opening == 0;
  return is_hidden ? Legend()
                   : legend_of(shown_settings(session.view.settings, session.document),
                               legend_facts(session.document));
}

/// Height of a line of text, in points.
float line_points() {
  return ImGui::GetFontSize() / units(1.0F) + 2.0F;
}

}  // namespace

float legend_strip(const Session& session, const Layout& layout) {
  const Legend legend = shown_legend(session);
  if (layout.width != Layout::Width::small || legend.is_empty()) return 0.0F;
  const float height = units(legend_height(legend, line_points()));
  return height < 0.4F * layout.model.height() ? std::round(height) : 0.0F;
}

void draw_legend(const Session& session, float strip, Ui& ui) {
  const Legend legend = shown_legend(session);
  const Rect& model = ui.layout.model;
  const bool is_small = ui.layout.width == Layout::Width::small;
  if (legend.is_empty() || (is_small && strip == 0.0F)) return;
  const float unit = units(1.0F);
  const float margin = is_small ? 0.0F : kMarginPoints;
  const float line = line_points();
  const float width = std::min(kLegendWidthPoints, model.width() / unit - 2.0F * margin);
  const float height = legend_height(legend, line);
  if (!is_small && height > model.height() / unit - 2.0F * margin) return;
  // Below all panels and dialogs. The mouse does not see it.
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 at{model.x0 + margin * unit, model.y0 - strip + margin * unit};
  if (is_small)
    list.AddRectFilled({model.x0, model.y0 - strip}, {model.x1, model.y0},
                       color_of(legend.ground, 1.0F));
  const auto place = [&](const glm::vec2& point) {
    return ImVec2{at.x + unit * point.x, at.y + unit * point.y};
  };
  draw_legend(
      legend, width,
      {.fill =
           [&](glm::vec2 from, glm::vec2 to, const render::Color& color, float opacity) {
             list.AddRectFilled(place(from), place(to), color_of(color, opacity));
           },
       .text =
           [&](glm::vec2 point, const std::string& text) {
             list.AddText(place(point), color_of(legend.text, 1.0F), text.c_str());
           },
       .text_width =
           [&](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x / unit; },
       .line = line});
  const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
  ui.noted.widgets["legend"] = {scale.x * at.x, scale.y * at.y, scale.x * (at.x + width * unit),
                                scale.y * (at.y + height * unit)};
}

}  // namespace mesher::app
