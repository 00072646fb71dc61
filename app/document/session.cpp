#include "app/document/session.h"

namespace mesher::app {

void show_model(Session& session, Model&& model, const std::filesystem::path& file) {
  const Statistics stats = statistics(model.mesh);
  show_model(session, std::move(model), stats, file);
}

void show_model(Session& session, Model&& model, const Statistics& stats,
                const std::filesystem::path& file) {
  session.model = std::move(model);
  session.statistics = stats;
  session.file = file;
  session.edits = {};
  session.edits.opened_faces = stats.faces;
  session.saving = {};
  session.progressive.forget();
  session.creases.forget_edges();
  session.error.clear();
  session.notice.clear();
  ++session.model_generation;
  session.camera.frame(session.statistics.box, session.aspect());
}

void set_default_view(render::Camera& camera) {
  constexpr double kDegree = 3.14159265358979 / 180.0;
  camera.set_angles(25.0 * kDegree, 15.0 * kDegree);
}

}  // namespace mesher::app
