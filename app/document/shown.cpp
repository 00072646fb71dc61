#include "app/document/shown.h"

#include <utility>

#include "app/document/automatic_level.h"
#include "engine/simplify/attributes.h"

namespace mesher::app {
namespace {

/// Returns a level in the form that carry_attributes expects.
simplify::Simplified as_simplified(const Mesh& level, std::span<const Vertex> vertex_source,
                                   std::span<const Halfedge> face_source,
                                   std::uint32_t vertices_before) {
  simplify::Simplified result;
  result.mesh = level;
  result.vertex_source.assign(vertex_source.begin(), vertex_source.begin() + level.vertex_count());
  result.face_source.resize(level.face_count());
  for (std::size_t f = 0; f < result.face_source.size(); ++f)
    result.face_source[f] = Mesh::face(face_source[f]);
  result.report.vertices_before = vertices_before;
  result.report.collapses = 1;  // even at full detail the ids differ
  return result;
}

}  // namespace

const Mesh& shown_mesh(const Document& document) {
  return document.progressive.is_on() ? document.progressive.mesh().mesh() : document.model.mesh;
}

Mesh& shown_mesh(Document& document) {
  return document.progressive.is_on() ? document.progressive.mesh().mesh() : document.model.mesh;
}

Shape shown_shape(const Document& document) {
  if (!document.progressive.is_on()) return {document.model.mesh, document.model.attributes};
  const DetailLevels& levels = document.progressive.levels();
  const Model& model = document.model;
  if (levels.vertex_source.empty()) return {shown_mesh(document), {}};
  return level_shape(shown_mesh(document), levels.vertex_source, levels.face_source, model.mesh,
                     model.attributes);
}

Shape level_shape(const Mesh& level, std::span<const Vertex> vertex_source,
                  std::span<const Halfedge> face_source, const Mesh& model,
                  const Attributes& attributes) {
  if (attributes.is_empty()) return {level, {}};
  simplify::Simplified result =
      as_simplified(level, vertex_source, face_source, model.vertex_count());
  Attributes carried = simplify::carry_attributes(attributes, model.origins(), result).attributes;
  return {std::move(result.mesh), std::move(carried)};
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
  if (!view.is_on()) return {.corner_normals = shading_normals(document.model, document.edits)};
  if (!view.has_geomorph()) return {};
  const progressive::Geomorph& geomorph = view.levels().geomorph;
  return {.vertex_normals = geomorph.normals(),
          .morph = {.heads = geomorph.heads(), .splits = geomorph.splits()}};
}

render::MarkedEdges marked_edges(const CreaseMode& creases) {
  return {creases.selected, creases.hovered};
}

std::span<const glm::vec3> shading_normals(const Model& model, const Edits& edits) {
  const auto& level = edits.subdivision;
  const Array<glm::vec3>& normals = model.attributes.normal;
  const bool has_limit = level && level->level > 0 && level->rules.limit &&
                         subdivide::traits(level->rules.scheme).has_limit;
  if (!has_limit || normals.size() != model.mesh.halfedge_count()) return {};
  return normals;
}

std::uint32_t shown_level(const Edits& edits) {
  return edits.subdivision ? edits.subdivision->level : 0;
}

double shown_pixels_per_unit(const Document& document, const View& view) {
  return pixels_per_unit(view.camera, document.statistics.box, view.size());
}

}  // namespace mesher::app
