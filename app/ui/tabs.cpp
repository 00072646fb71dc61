#include "app/document/tabs.h"

#include <imgui.h>

#include "app/files/leave.h"
#include "app/ui/controls.h"
#include "app/ui/panels.h"

namespace mesher::app {
namespace {

/// Shows a tab, unless the shown document cannot be left now.
bool try_to_show(Session& session, std::size_t tab) {
  const char* reason = tab_refusal(session.document);
  if (reason != nullptr) {
    session.document.notice = reason;
  } else {
    show_tab(session, tab);
  }
  return reason == nullptr;
}

}  // namespace

void draw_tabs(Session& session, Ui& ui) {
  if (!begin_part("tabs", ui.layout.tabs, false)) return;
  std::optional<std::size_t> chosen;
  std::optional<std::size_t> closed;
  const std::size_t shown = shown_tab(session);
  if (ImGui::BeginTabBar("models", ImGuiTabBarFlags_FittingPolicyScroll)) {
    for (std::size_t i = 0; i < tab_count(session); ++i) {
      const Document& document = document_of(session, i);
      const std::string name = (has_unsaved_edits(document) ? "*" : "") + document.model.name +
                               "###" + std::to_string(document.opening);
      bool is_open = true;
      // ImGui remembers the tab that was clicked last; the session may have shown another one.
      const bool must_select = i == shown && ui.tab_shown != document.opening;
      if (ImGui::BeginTabItem(name.c_str(), &is_open,
                              must_select ? ImGuiTabItemFlags_SetSelected : 0)) {
        if (!must_select && ui.tab_shown == session.document.opening) chosen = i;
        ImGui::EndTabItem();
      }
      note_widget("tab " + document.model.name);
      tooltip(document.file.c_str());
      if (!is_open) closed = i;
    }
    ImGui::EndTabBar();
  }
  ui.tab_shown = session.document.opening;
  end_part(ui.areas);
  if (closed && (*closed == shown || try_to_show(session, *closed)))
    request_leave(session, Leaving::close);
  else if (chosen && *chosen != shown && !try_to_show(session, *chosen))
    ui.tab_shown = 0;
}

}  // namespace mesher::app
