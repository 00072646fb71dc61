#include "app/viewer/scene_mirror.h"

#include "app/document/shown.h"

namespace mesher::app {

bool SceneMirror::update(Document& document, const render::Settings& chosen) {
  bool is_changed = generation_ != document.model_generation;
  if (is_changed) mesh_.invalidate();
  generation_ = document.model_generation;
  const std::uint32_t faces_before = mesh_.face_count();
  const render::Settings settings = shown_settings(chosen, document);
  const render::UploadStats upload =
      mesh_.apply(shown_mesh(document), settings, shown_sources(document));
  if (mesh_.mark(marked_edges(document.creases))) is_changed = true;
  if (upload.uploaded_bytes > 0) last_upload_ = upload;
  settings_ = settings;
  return is_changed || upload.uploaded_bytes > 0 || mesh_.face_count() != faces_before;
}

}  // namespace mesher::app
