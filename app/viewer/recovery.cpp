#include "app/viewer/recovery.h"

#include <utility>

#include "app/edit/model_edit.h"
#include "app/edit/progressive_edits.h"
#include "engine/core/error.h"

namespace mesher::app {

Recovery::Outcome Recovery::update() {
  try {
    const bool is_changed = mirror_.update(session_);
    good_settings_ = session_.settings;
    good_revision_ = session_.edits.revision;
    return is_changed ? Outcome::changed : Outcome::unchanged;
  } catch (const Error& error) {
    if (!revert_settings() && !revert_edit() && !revert_mode()) throw;
    session_.error = error.what();
    mirror_.invalidate();
    return Outcome::reverted;
  }
}

void Recovery::show(LoadedModel&& loaded) {
  work_.stop();
  Session before;
  std::swap(before.progressive, session_.progressive);
  session_.progressive.change(before.progressive.settings());
  std::swap(before.model, session_.model);
  std::swap(before.edits, session_.edits);
  before.statistics = session_.statistics;
  before.file = session_.file;
  before.camera = session_.camera;
  show_model(session_, std::move(loaded.model), loaded.statistics, loaded.file);
  try {
    mirror_.update(session_);
    good_settings_ = session_.settings;
    good_revision_ = session_.edits.revision;
  } catch (const Error& error) {
    show_model(session_, std::move(before.model), before.statistics, before.file);
    session_.edits = std::move(before.edits);
    session_.progressive = std::move(before.progressive);
    if (session_.progressive.is_on()) enter_progressive(session_);
    session_.camera = before.camera;
    session_.error = error.what();
  }
}

bool Recovery::revert_settings() {
  if (!good_settings_ || *good_settings_ == session_.settings) return false;
  session_.settings = *good_settings_;
  return true;
}

bool Recovery::revert_edit() {
  if (!good_revision_ || *good_revision_ == session_.edits.revision) return false;
  work_.stop_edits();  // they started from the model that cannot be shown
  return take_back_last_edit(session_);
}

// A progressive mesh from a file may never have been shown at full detail: half of its splits may
// fit.
bool Recovery::revert_mode() {
  ProgressiveView& view = session_.progressive;
  if (!view.is_on()) return false;
  work_.stop_arrival();
  const std::uint32_t level = view.is_on() ? view.mesh().level() : 0;
  if (level > 0 && view.levels().vertex_source.empty()) {
    view.move_to_level(level / 2);
  } else {
    forget_progressive(session_);
  }
  return true;
}

}  // namespace mesher::app
