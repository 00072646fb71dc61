#pragma once

#include <cstdint>

#include "engine/mesh/ids.h"
#include "engine/scene/scene.h"

namespace mesher::app {

struct Document;

/// The animation of a scene that is shown. It has no clock.
struct Playback {
  std::uint32_t animation = kNone;  ///< of the scene; none: its meshes are at rest
  double time_s = 0.0;
  bool is_playing = false;

  bool is_on() const { return animation != kNone; }
  friend bool operator==(const Playback&, const Playback&) = default;
};

/// The poses of the nodes that are shown.
scene::NodePoses shown_poses(const Document& document);
/// Shows an animation from its beginning, or the meshes at rest (kNone).
void choose_animation(Document& document, std::uint32_t animation);
/// Starts or pauses; without a chosen animation, the first one starts. Pre: there is an animation.
void play_animation(Document& document);
/// Advances a playing animation, which begins again after its end. Returns whether it plays.
bool advance_animation(Document& document, double step_s);
bool has_animations(const Document& document);

}  // namespace mesher::app
