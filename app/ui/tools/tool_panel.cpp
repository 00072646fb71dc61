#include <imgui.h>

#include "app/ui/controls.h"
#include "app/ui/panels.h"

namespace mesher::app {
namespace {

void draw_contents(Session& session, Tool tool, Ui& ui) {
  Document& document = session.document;
  switch (tool) {
    case Tool::model:
      return draw_model_tool(document, ui);
    case Tool::look:
      return draw_look_tool(session.view.settings);
    case Tool::simplify:
      return draw_simplify_tool(document, ui);
    case Tool::subdivide:
      return draw_subdivide_tool(document);
    case Tool::creases:
      return draw_crease_tool(document, ui);
    case Tool::levels:
      return draw_levels_tool(document, session.view, ui);
  }
}

bool edits_model(Tool tool) {
  return tool == Tool::simplify || tool == Tool::subdivide || tool == Tool::creases;
}

}  // namespace

void draw_tool_panel(Session& session, Ui& ui) {
  // The dock at the left already shows the facts of the model.
  const bool is_shown = session.tool == Tool::model && !ui.layout.facts.is_empty();
  const Tool tool = is_shown ? Tool::look : session.tool;
  if (!begin_part(kToolPanel, ui.layout.panel)) return;
  ImGui::TextUnformatted(text_of(tool).label);
  const bool is_locked = session.document.progressive.is_on() && edits_model(tool);
  if (is_locked) {
    remark_text(
        "A level of the progressive mesh is shown. To edit the model, leave progressive mode (P), "
        "or use this level as the model (K).");
  }
  begin_disabled(is_locked);
  draw_contents(session, tool, ui);
  end_disabled();
  end_part(ui.areas);
}

}  // namespace mesher::app
