#include "app/document/document.h"

#include <utility>

namespace mesher::app {

void replace_model(Document& document, Model&& model, const Statistics& stats,
                   const std::filesystem::path& file) {
  document.model = std::move(model);
  document.statistics = stats;
  document.file = file;
  document.edits = {};
  document.edits.opened_faces = stats.faces;
  document.progressive.forget();
  document.creases.forget_edges();
  document.error.clear();
  document.notice.clear();
  ++document.model_generation;
}

}  // namespace mesher::app
