#include "app/document/session.h"

#include <utility>

namespace mesher::app {

bool has_question(const Session& session) {
  return session.unsaved || !session.lost.empty();
}

void show_model(Session& session, Model&& model, const std::filesystem::path& file) {
  const Statistics stats = scene::statistics(model.mesh, model.attributes, model.scene.get());
  show_model(session, std::move(model), stats, file);
}

void show_model(Session& session, Model&& model, const Statistics& stats,
                const std::filesystem::path& file) {
  replace_model(session.document, std::move(model), stats, file);
  session.saving = {};
  session.view.camera.frame(stats.box, session.view.aspect());
}

}  // namespace mesher::app
