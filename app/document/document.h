#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "app/document/creases.h"
#include "app/document/edits.h"
#include "app/document/model_source.h"
#include "app/document/playback.h"
#include "app/document/progressive_view.h"
#include "app/document/simplification.h"
#include "engine/mesh/model.h"
#include "engine/mesh/statistics.h"
#include "engine/scene/placed.h"

namespace mesher::app {

/// What the program works on: one model, its edits, and the rules of the next edits. It knows
/// neither how it is looked at (View) nor which panels are open (Session).
struct Document {
  std::filesystem::path file;
  ModelSource source;  ///< how `model` was read from `file`
  Model model;
  Statistics statistics;
  /// A coarse copy of the model as it was opened, to be shown while drawing the model would take
  /// too long; null: it was not made then.
  std::shared_ptr<const Mesh> stand_in;
  Playback playback;          ///< of the model's scene
  scene::HiddenNodes hidden;  ///< of the model's scene
  /// The mesh of the scene that edits apply to; none: to all.
  std::uint32_t chosen_mesh = kNone;
  Edits edits;
  SimplifySettings simplify;
  subdivide::SubdivideOptions subdivide;  ///< those of kSubdivideRules
  CreaseMode creases;
  ProgressiveView progressive;
  std::string error;   ///< the last failure, until dismissed
  std::string notice;  ///< the last event that the picture does not show
  /// Increases whenever another mesh is shown, so that copies of the mesh can tell that they are
  /// outdated.
  std::uint64_t model_generation = 0;
  /// Unique among all files that the program has opened; 0: none was opened.
  std::uint64_t opening = 0;
};

/// Returns whether there are edits that no file holds, or that are still to be made.
bool has_unsaved_edits(const Document& document);

/// Replaces the model, and discards the edits of the previous one. The rules stay. O(1).
void replace_model(Document& document, Model&& model, const Statistics& statistics,
                   const std::filesystem::path& file);

}  // namespace mesher::app
