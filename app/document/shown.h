#pragma once

#include <optional>
#include <span>

#include "app/document/document.h"
#include "app/document/view.h"
#include "engine/mesh/shape.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/settings.h"
#include "engine/render/sources.h"

namespace mesher::app {

// The drawn mesh is the model or, in progressive mode, a level of its progressive mesh.

const Mesh& shown_mesh(const Document& document);
/// For the GPU's mirror of the mesh, which clears the mesh's change log.
Mesh& shown_mesh(Document& document);
/// Returns whether what the scene of the model shows is drawn, rather than the model itself: meshes
/// at several places, posed by joints, or hidden. Levels of a progressive mesh are drawn as they
/// are.
bool shows_placed(const Document& document);
/// That mesh with all geomorphs finished, and its attributes.
Shape shown_shape(const Document& document);
/// Returns the attributes of the shown level of a progressive mesh, if it has any. O(F).
std::optional<Attributes> level_attributes(const Document& document);
/// The settings to draw with: those of the view, with the lines of crease editing and the state of
/// the geomorph.
render::Settings shown_settings(render::Settings settings, const Document& document);
/// What the renderer needs besides the mesh. The images of materials are still to be decoded.
render::Sources shown_sources(const Document& document);
/// The edges that the renderer highlights: the selection, and the edge under the cursor.
render::MarkedEdges marked_edges(const CreaseMode& creases);
/// Normals to shade the model with, one per corner: those of the limit surface if it is shown;
/// otherwise empty, and the renderer computes normals from the faces.
std::span<const glm::vec3> shading_normals(const Edits& edits);
/// The level of subdivision that the model shows: 0 if it is not subdivided.
std::uint32_t shown_level(const Edits& edits);
/// Pixels per model unit on the screen.
double shown_pixels_per_unit(const Document& document, const View& view);

}  // namespace mesher::app
