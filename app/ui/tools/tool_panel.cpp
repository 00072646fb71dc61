#include <imgui.h>

#include <algorithm>

#include "app/ui/controls.h"
#include "app/ui/panels.h"
#include "app/ui/style.h"

namespace mesher::app {
namespace {

// A lower panel has its buttons in sight all the time.
constexpr float kLowPoints = 480.0F;

/// Pre: the tool has blocks.
void draw_block(Session& session, Tool tool, Block block, Ui& ui) {
  Document& document = session.document;
  switch (tool) {
    case Tool::simplify:
      return draw_simplify_tool(document, block, ui);
    case Tool::subdivide:
      return draw_subdivide_tool(document, block);
    case Tool::creases:
      return draw_crease_tool(document, block, ui);
    case Tool::levels:
      return draw_levels_tool(document, session.view, block, ui);
    case Tool::model:
    case Tool::look:
      break;
  }
}

void draw_blocks(Session& session, Tool tool, Ui& ui) {
  const auto draw = [&](Block block) { draw_block(session, tool, block, ui); };
  if (ui.layout.panel.height() >= units(kLowPoints)) {
    for (const Block block : {Block::settings, Block::apply, Block::result})
      draw(block);
    return;
  }
  const float height = ImGui::GetContentRegionAvail().y - ui.apply_height;
  ImGui::BeginChild("blocks", {0.0F, std::max(height, units(24.0F))});
  draw(Block::settings);
  draw(Block::result);
  ImGui::EndChild();
  const float top = ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y;
  draw(Block::apply);
  ui.apply_height = ImGui::GetCursorPosY() - top;
}

void draw_contents(Session& session, Tool tool, Ui& ui) {
  if (tool == Tool::model) return draw_model_tool(session.document, ui);
  if (tool == Tool::look) return draw_look_tool(session.view);
  draw_blocks(session, tool, ui);
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
