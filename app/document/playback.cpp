#include "app/document/playback.h"

#include <cmath>

#include "app/document/document.h"

namespace mesher::app {

bool has_animations(const Document& document) {
  return document.model.scene != nullptr && !document.model.scene->animations.empty();
}

scene::NodePoses shown_poses(const Document& document) {
  const Playback& playback = document.playback;
  if (!playback.is_on()) return {};
  return pose_at(document.model.scene->animations[playback.animation], playback.time_s);
}

void choose_animation(Document& document, std::uint32_t animation) {
  document.playback = {.animation = animation};
}

void play_animation(Document& document) {
  if (!document.playback.is_on()) choose_animation(document, 0);
  document.playback.is_playing = !document.playback.is_playing;
}

bool advance_animation(Document& document, double step_s) {
  Playback& playback = document.playback;
  if (!playback.is_playing) return false;
  const double duration = document.model.scene->animations[playback.animation].duration_s;
  playback.time_s = duration > 0.0 ? std::fmod(playback.time_s + step_s, duration) : 0.0;
  return true;
}

}  // namespace mesher::app
