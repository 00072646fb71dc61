#include "app/viewer/scene_mirror.h"

#include "app/document/shown.h"
#include "engine/io/image_decode.h"

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

/// Makes what the scene shows, if that is not the model itself. Returns whether another mesh is to
/// be drawn than before.
bool SceneMirror::place(const Document& document) {
  if (!shows_placed(document)) {
    const bool was_placed = placed_.has_value();
    placed_.reset();
    return was_placed;
  }
  const bool is_same = placed_ && placed_->generation == document.model_generation &&
                       placed_->revision == document.edits.revision &&
                       placed_->hidden == document.hidden;
  if (is_same && placed_->playback == document.playback) return false;
  if (!is_same) {
    placed_.emplace(Placed{ScenePicture(document), document.model_generation,
                           document.edits.revision, document.hidden, document.playback});
  }
  placed_->playback = document.playback;
  return placed_->picture.pose(document) || !is_same;
}

bool SceneMirror::update(Document& document, const render::Settings& chosen,
                         const std::optional<render::PictureView>& picture) {
  bool is_changed = generation_ != document.model_generation;
  if (place(document)) is_changed = true;
  if (is_changed) mesh_.invalidate();
  generation_ = document.model_generation;
  const std::uint32_t faces_before = mesh_.face_count();
  const render::Settings settings = shown_settings(chosen, document);
  render::Sources sources = shown_sources(document);
  if (document.progressive.is_on())
    sources.appearance.changes = &document.progressive.attributes().changes();
  if (placed_) {
    sources.corner_normals = {};
    sources.appearance.attributes = &placed_->picture.attributes();
    sources.pose = placed_->picture.pose_source();
  } else {
    sources.appearance.picture = picture;
  }
  std::vector<std::string> problems;
  sources.appearance.decode = [&](std::span<const ImageRequest> images, const TakeImage& take) {
    io::decode_images(*sources.appearance.materials, images, take, problems);
  };
  Mesh& mesh = placed_ ? placed_->picture.mesh() : shown_mesh(document);
  const render::UploadStats upload = mesh_.apply(mesh, settings, sources);
  if (std::exchange(materials_, document.model.materials) != document.model.materials)
    not_decoded_.clear();
  for (std::string& problem : problems)
    document.notice = not_decoded_.emplace_back(std::move(problem));
  // The edges of copies have other numbers.
  if (mesh_.mark(placed_ && !placed_->picture.keeps_elements() ? render::MarkedEdges()
                                                               : marked_edges(document.creases)))
    is_changed = true;
  if (upload.uploaded_bytes > 0) last_upload_ = upload;
  settings_ = settings;
  return is_changed || upload.uploaded_bytes > 0 || mesh_.face_count() != faces_before;
}

std::vector<std::string> SceneMirror::not_drawn() const {
  std::vector<std::string> lines = not_decoded_;
  for (std::string& line : mesh_.appearance().problems())
    lines.push_back(std::move(line));
  return lines;
}

}  // namespace mesher::app
