#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/progressive_view.h"
#include "app/shape.h"
#include "engine/mesh/mesh.h"
#include "engine/render/settings.h"
#include "engine/render/sources.h"
#include "engine/simplify/options.h"

namespace mesher::app {

struct Session;

/// A progressive mesh to be made in the background: simplification of a model down to a base.
struct ProgressiveWork {
  std::shared_ptr<const Shape> start;
  SimplifyOptions options;
};

/// What a progressive mesh from a file lacks yet. The mesh is the worker's to take.
struct GeomorphWork {
  std::shared_ptr<ProgressiveMesh> mesh;
};

/// A level that becomes the model.
struct KeptLevel {
  std::shared_ptr<const Shape> shape;
};

/// Turns the mode on and off in which the model is shown as a progressive mesh. The model stays
/// what it is: edits are refused meanwhile, and afterwards it is shown as it was. What was made for
/// it is kept until the model changes; where there is none, it is asked for.
void toggle_progressive(Session& session);
/// Turns the mode on; geomorphs that are missing are asked for. Pre: there is a progressive mesh.
void enter_progressive(Session& session);
void leave_progressive(Session& session);
/// The model has changed: its progressive mesh is that of another one.
void forget_progressive(Session& session);
/// Whether the mode is on, in which nothing may be edited; the notice says what to do about it.
bool refuse_in_progressive(Session& session);

/// The shown level becomes the model, as an edit that can be undone.
void request_keep_level(Session& session);

// The work, as in app/edits.h.

DetailLevels perform_progressive(const ProgressiveWork& work, Progress* progress);
/// Takes what was made; the first one turns the mode on, unless creases are edited by now.
void finish_progressive(Session& session, DetailLevels&& levels);

// What is drawn: the model, or in the mode a level of it.

const Mesh& shown_mesh(const Session& session);
/// For its mirror, which clears the mesh's log.
Mesh& shown_mesh(Session& session);
/// That mesh with all that has grown, and what files say beyond shape.
Shape shown_shape(const Session& session);
/// The session's settings, with how far splits have grown.
render::Settings shown_settings(const Session& session);
render::Sources shown_sources(const Session& session);
/// How large a model unit is on the screen.
double shown_pixels_a_unit(const Session& session);

}  // namespace mesher::app
