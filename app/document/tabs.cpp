#include "app/document/tabs.h"

#include <algorithm>
#include <utility>

#include "app/document/session.h"
#include "engine/core/assert.h"

namespace mesher::app {
namespace {

/// Larger than that of any open document, so that copies of the shown mesh become outdated.
std::uint64_t next_generation(const Session& session) {
  std::uint64_t last = session.document.model_generation;
  for (const auto* side : {&session.tabs.before, &session.tabs.after}) {
    for (const HiddenTab& tab : *side)
      last = std::max(last, tab.document.model_generation);
  }
  return last + 1;
}

HiddenTab hide(Session& session) {
  Document& document = session.document;
  document.creases.hovered = {};
  session.saving = {};
  View& view = session.view;
  return {std::exchange(document, {}), view.camera, view.window, view.insets};
}

void show(Session& session, HiddenTab&& tab, std::uint64_t generation) {
  session.document = std::move(tab.document);
  session.document.model_generation = generation;
  View& view = session.view;
  const glm::dvec2 window = std::exchange(view.window, tab.window);
  const Insets insets = std::exchange(view.insets, tab.insets);
  view.camera = tab.camera;
  // The window may have changed its size meanwhile.
  resize(view, session.document.statistics.box, window, insets);
}

HiddenTab take_last(std::vector<HiddenTab>& tabs) {
  HiddenTab tab = std::move(tabs.back());
  tabs.pop_back();
  return tab;
}

HiddenTab take_first(std::vector<HiddenTab>& tabs) {
  HiddenTab tab = std::move(tabs.front());
  tabs.erase(tabs.begin());
  return tab;
}

void copy_rules(const Document& from, Document& to) {
  to.simplify = from.simplify;
  to.subdivide = from.subdivide;
  to.creases.tag_angle_deg = from.creases.tag_angle_deg;
  to.progressive.change(from.progressive.settings());
}

}  // namespace

std::size_t tab_count(const Session& session) {
  return session.tabs.before.size() + 1 + session.tabs.after.size();
}

std::size_t shown_tab(const Session& session) {
  return session.tabs.before.size();
}

const Document& document_of(const Session& session, std::size_t tab) {
  const std::size_t shown = shown_tab(session);
  if (tab == shown) return session.document;
  return tab < shown ? session.tabs.before[tab].document
                     : session.tabs.after[tab - shown - 1].document;
}

Document* document_opened_as(Session& session, std::uint64_t opening) {
  if (session.document.opening == opening) return &session.document;
  for (auto* side : {&session.tabs.before, &session.tabs.after}) {
    for (HiddenTab& tab : *side)
      if (tab.document.opening == opening) return &tab.document;
  }
  return nullptr;
}

const char* tab_refusal(const Document& document) {
  if (document.progressive.is_arriving())
    return "the file is still loading; press Esc to stop loading";
  return document.edits.is_changing ? "an edit is running; wait for it, or press Esc to cancel it"
                                    : nullptr;
}

void show_tab(Session& session, std::size_t tab) {
  if (tab == shown_tab(session)) return;
  MESHER_ASSERT(tab < tab_count(session) && !session.document.progressive.is_arriving());
  const std::uint64_t generation = next_generation(session);
  auto& [before, after] = session.tabs;
  HiddenTab hidden = hide(session);
  if (tab < before.size()) {
    after.insert(after.begin(), std::move(hidden));
    while (before.size() > tab + 1)
      after.insert(after.begin(), take_last(before));
    show(session, take_last(before), generation);
  } else {
    before.push_back(std::move(hidden));
    while (before.size() < tab)
      before.push_back(take_first(after));
    show(session, take_first(after), generation);
  }
}

void add_tab(Session& session) {
  if (session.document.opening == 0) return;
  const std::uint64_t generation = next_generation(session);
  session.tabs.before.push_back(hide(session));
  copy_rules(session.tabs.before.back().document, session.document);
  session.document.model_generation = generation;
}

void close_shown_tab(Session& session) {
  MESHER_ASSERT(!session.document.progressive.is_arriving());
  const std::uint64_t generation = next_generation(session);
  session.saving = {};
  auto& [before, after] = session.tabs;
  if (tab_count(session) == 1) {
    const Document closed = std::exchange(session.document, {});
    copy_rules(closed, session.document);
    session.document.model_generation = generation;
    session.shows_start = true;
    return;
  }
  show(session, after.empty() ? take_last(before) : take_first(after), generation);
}

void close_hidden_tab(Session& session, std::uint64_t opening) {
  for (auto* side : {&session.tabs.before, &session.tabs.after}) {
    std::erase_if(*side, [&](const HiddenTab& tab) {
      return tab.document.opening == opening && !has_unsaved_edits(tab.document);
    });
  }
}

}  // namespace mesher::app
