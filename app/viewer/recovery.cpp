#include "app/viewer/recovery.h"

#include <utility>

#include "app/document/tabs.h"
#include "app/edit/model_edit.h"
#include "app/edit/progressive_edits.h"
#include "app/files/restore.h"
#include "engine/gpu/result.h"

namespace mesher::app {

Recovery::Outcome Recovery::update() {
  try {
    const bool is_changed = graphics_.mirror().update(session_.document, session_.view.settings);
    good_settings_ = session_.view.settings;
    good_revision_ = session_.document.edits.revision;
    good_opening_ = session_.document.opening;
    close_hidden_tab(session_, session_.sample);
    return is_changed ? Outcome::changed : Outcome::unchanged;
  } catch (const gpu::LostError& lost) {
    // It says nothing about the change. A second loss throws GraphicsFailed.
    restart(lost);
    return update();
  } catch (const Error& error) {
    if (!revert_settings() && !revert_tab() && !revert_edit() && !revert_mode()) throw;
    session_.document.error = error.what();
    graphics_.mirror().invalidate();
    return Outcome::reverted;
  }
}

void Recovery::restart(const DeviceError& failure) {
  graphics_.restart(failure.what());
  session_.document.notice = std::string("restarted the graphics: ") + failure.what();
}

void Recovery::show(LoadedModel&& loaded) {
  Document& document = session_.document;
  const bool is_first = document.opening == 0;
  add_tab(session_);
  show_model(session_, std::move(loaded.model), loaded.statistics, loaded.file);
  document.source = loaded.source;
  document.stand_in = loaded.stand_in;
  if (is_first && frame_first_) {
    frame_first_(session_);
  } else {
    frame_from_default_view(session_.view, document.statistics.box);
  }
  const std::uint64_t opening = document.opening;
  if (update() == Outcome::reverted) return close_hidden_tab(session_, opening);
  if (loaded.lost) request_lost_edits(document, *loaded.lost);
}

bool Recovery::revert_settings() {
  if (!good_settings_ || *good_settings_ == session_.view.settings) return false;
  session_.view.settings = *good_settings_;
  return true;
}

bool Recovery::revert_edit() {
  if (!good_revision_ || *good_revision_ == session_.document.edits.revision) return false;
  work_.stop_edits();  // they started from the model that cannot be shown
  return take_back_last_edit(session_.document);
}

// A progressive mesh from a file may never have been shown at full detail: half of its splits may
// fit.
bool Recovery::revert_mode() {
  ProgressiveView& view = session_.document.progressive;
  if (!view.is_on()) return false;
  work_.stop_arrival();
  const std::uint32_t level = view.is_on() ? view.mesh().level() : 0;
  if (level > 0 && view.levels().vertex_source.empty()) {
    view.move_to_level(level / 2);
  } else {
    forget_progressive(session_.document);
  }
  return true;
}

/// Goes back to the model that was shown last.
bool Recovery::revert_tab() {
  const std::uint64_t failed = session_.document.opening;
  if (good_opening_ == 0 || good_opening_ == failed) return false;
  work_.stop_arrival();
  for (std::size_t i = 0; i < tab_count(session_); ++i) {
    if (document_of(session_, i).opening != good_opening_) continue;
    show_tab(session_, i);
    return true;
  }
  return false;
}

}  // namespace mesher::app
