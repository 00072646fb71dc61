#include "app/viewer/scene_mirror.h"

#include "app/document/shown.h"

namespace mesher::app {

VkRect2D model_rectangle(const View& view, const VkExtent2D& extent) {
  const auto part = [](double from, double length, std::uint32_t most) {
    const auto first = std::clamp<std::int32_t>(static_cast<std::int32_t>(from), 0,
                                                static_cast<std::int32_t>(most) - 1);
    const std::uint32_t rest = most - static_cast<std::uint32_t>(first);
    return std::pair{first, std::clamp(static_cast<std::uint32_t>(length), 1U, rest)};
  };
  const auto [x, width] = part(view.corner().x, view.size().x, extent.width);
  const auto [y, height] = part(view.corner().y, view.size().y, extent.height);
  return {{x, y}, {width, height}};
}

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
