#include "app/viewer/recovery.h"

#include <utility>

#include "app/edit/model_edit.h"
#include "app/edit/progressive_edits.h"
#include "app/files/restore.h"
#include "engine/core/error.h"

namespace mesher::app {

Recovery::Outcome Recovery::update() {
  try {
    const bool is_changed = mirror_.update(session_.document, session_.view.settings);
    good_settings_ = session_.view.settings;
    good_revision_ = session_.document.edits.revision;
    return is_changed ? Outcome::changed : Outcome::unchanged;
  } catch (const Error& error) {
    if (!revert_settings() && !revert_edit() && !revert_mode()) throw;
    session_.document.error = error.what();
    mirror_.invalidate();
    return Outcome::reverted;
  }
}

void Recovery::show(LoadedModel&& loaded) {
  work_.stop();
  Document& document = session_.document;
  Document before;
  std::swap(before.progressive, document.progressive);
  document.progressive.change(before.progressive.settings());
  std::swap(before.model, document.model);
  std::swap(before.edits, document.edits);
  before.statistics = document.statistics;
  before.file = document.file;
  before.source = document.source;
  const render::Camera camera = session_.view.camera;
  show_model(session_, std::move(loaded.model), loaded.statistics, loaded.file);
  document.source = loaded.source;
  try {
    mirror_.update(document, session_.view.settings);
    good_settings_ = session_.view.settings;
    good_revision_ = document.edits.revision;
    if (loaded.lost) request_lost_edits(document, *loaded.lost);
  } catch (const Error& error) {
    show_model(session_, std::move(before.model), before.statistics, before.file);
    document.edits = std::move(before.edits);
    document.source = before.source;
    document.progressive = std::move(before.progressive);
    if (document.progressive.is_on()) enter_progressive(document);
    session_.view.camera = camera;
    document.error = error.what();
  }
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

}  // namespace mesher::app
