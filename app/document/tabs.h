#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/document/document.h"
#include "app/document/view.h"

namespace mesher::app {

struct Session;

/// A model that is open and not shown, as it was last looked at.
struct HiddenTab {
  Document document;
  render::Camera camera;
  glm::dvec2 window{0.0};
  Insets insets;
};

/// The models that are open besides the shown one. Tabs are counted from the left: those of
/// `before`, the shown one, those of `after`.
struct Tabs {
  std::vector<HiddenTab> before;
  std::vector<HiddenTab> after;
};

std::size_t tab_count(const Session& session);
std::size_t shown_tab(const Session& session);
/// Pre: tab < tab_count(session).
const Document& document_of(const Session& session, std::size_t tab);
/// The open document with this number (Document::opening); null: it was closed.
Document* document_opened_as(Session& session, std::uint64_t opening);

/// Returns why another tab cannot be shown now; null: it can. An edit that is running, or a file
/// that is loading, belongs to the shown document.
const char* tab_refusal(const Document& document);

/// Shows another tab. Pre: the shown one is not loading. O(tabs).
void show_tab(Session& session, std::size_t tab);
/// Adds an empty tab after the shown one, with the same rules for edits, and shows it. If the shown
/// document is empty, does nothing. Pre: as for show_tab.
void add_tab(Session& session);
/// Closes the shown tab and shows the next one, or the one before the last. After the only one, an
/// empty document and the start screen are left. Pre: the shown one is not loading.
void close_shown_tab(Session& session);
/// Closes the hidden tab of the document with this number, if there is one without unsaved edits.
void close_hidden_tab(Session& session, std::uint64_t opening);

}  // namespace mesher::app
