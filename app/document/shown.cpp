#include "app/document/shown.h"

#include <utility>

#include "app/document/automatic_level.h"

namespace mesher::app {
const Mesh& shown_mesh(const Document& document) {
  return document.progressive.is_on() ? document.progressive.mesh().mesh() : document.model.mesh;
}

Mesh& shown_mesh(Document& document) {
  return document.progressive.is_on() ? document.progressive.mesh().mesh() : document.model.mesh;
}

bool shows_placed(const Document& document) {
  const scene::Scene* const scene = document.model.scene.get();
  return scene != nullptr && !document.progressive.is_on() &&
         (document.playback.is_on() || scene::differs_from_model(*scene, document.hidden));
}

Shape shown_shape(const Document& document) {
  if (!document.progressive.is_on()) return {document.model.mesh, document.model.attributes};
  std::optional<Attributes> attributes = level_attributes(document);
  return {shown_mesh(document), attributes ? std::move(*attributes) : Attributes()};
}

std::optional<Attributes> level_attributes(const Document& document) {
  const ProgressiveView& view = document.progressive;
  if (!view.is_on() || view.levels().attributes.is_empty()) return std::nullopt;
  return view.levels().attributes.at_level(shown_mesh(document));
}

render::Settings shown_settings(render::Settings settings, const Document& document) {
  settings.line_edges |= document.creases.is_on;
  const ProgressiveView& view = document.progressive;
  if (!view.is_on()) return settings;
  settings.geomorph = view.growth();
  settings.colors_by_split_order = view.settings().colors_by_split_order;
  settings.first_split_vertex = view.mesh().base_vertex_count();
  return settings;
}

render::Sources shown_sources(const Document& document) {
  const ProgressiveView& view = document.progressive;
  if (!view.is_on()) {
    return {.corner_normals = shading_normals(document.edits),
            .appearance = {.attributes = &document.model.attributes,
                           .materials = document.model.materials,
                           .decode = {}}};
  }
  if (!view.has_geomorph()) return {};
  const DetailLevels& levels = view.levels();
  return {.vertex_normals = levels.geomorph.normals(),
          .morph = {.heads = levels.geomorph.heads(), .splits = levels.geomorph.splits()},
          .appearance = {
              .attributes = levels.attributes.is_empty() ? nullptr : &levels.attributes.arrays(),
              .materials = document.model.materials,
              .decode = {},
              .morph = levels.attribute_morph.view()}};
}

render::MarkedEdges marked_edges(const CreaseMode& creases) {
  return {creases.selected, creases.hovered};
}

std::span<const glm::vec3> shading_normals(const Edits& edits) {
  const auto& level = edits.subdivision;
  if (!level || level->level == 0 || !level->limit_normals) return {};
  return *level->limit_normals;
}

std::uint32_t shown_level(const Edits& edits) {
  return edits.subdivision ? edits.subdivision->level : 0;
}

double shown_pixels_per_unit(const Document& document, const View& view) {
  return pixels_per_unit(view.camera, document.statistics.box, view.size());
}

}  // namespace mesher::app
