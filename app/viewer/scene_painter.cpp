#include "app/viewer/scene_painter.h"

#include <algorithm>
#include <utility>

#include "app/document/stand_in.h"
#include "engine/core/error.h"
#include "engine/gpu/result.h"

namespace mesher::app {
namespace {

// After longer frames there is one sample per pixel while the picture changes.
constexpr double kLongFrameSeconds = 0.040;
// A software renderer draws some millions per second, a GPU some hundreds of millions. The first
// pictures correct the guess.
constexpr double kGuessedSpeed = 4e7;
constexpr double kLeastSpeed = 1e5;
// Share of the last measurement in the estimate.
constexpr double kTrust = 0.5;
// Time of a slice: the panels and the copy need the rest of the frame.
constexpr double kSliceSeconds = 0.020;
// Frames with less work say more about the window than about the scene.
constexpr std::uint64_t kTellingWork = 20'000;
// Pauses between frames are not drawing time.
constexpr double kLongestFrame = 5.0;
// A stand-in is made again if the number of faces has changed by more than this factor.
constexpr double kSameFaces = 1.25;

bool is_similar(double faces, double others) {
  return faces <= kSameFaces * others && others <= kSameFaces * faces;
}

}  // namespace

ScenePainter::ScenePainter(gpu::Device& device, VkFormat format)
    : device_(device), format_(format), renderer_(device), triangles_per_second_(kGuessedSpeed) {}

void ScenePainter::invalidate() {
  drawn_.reset();
}

/// The time between frames that follow one another is the time of the work, because the presenter
/// waits for frames before the last one.
void ScenePainter::measure(double now_s) {
  const double seconds = now_s - std::exchange(last_s_, now_s);
  const std::uint64_t work = std::exchange(last_work_, 0);
  last_frame_s_ = seconds;
  if (work < kTellingWork || seconds <= 0.0 || seconds > kLongestFrame) return;
  const double speed = std::max(double(work) / seconds, kLeastSpeed);
  triangles_per_second_ += kTrust * (speed - triangles_per_second_);
}

bool ScenePainter::is_heavy(SceneMirror& mirror) const {
  const auto work = double(render::Renderer::work(mirror.mesh(), mirror.settings()));
  return work / triangles_per_second_ > kFrameSeconds;
}

/// While the picture changes in every frame and frames take long, there is one sample per pixel,
/// because latency matters more than antialiasing. The first frame that shows nothing new is
/// antialiased.
unsigned ScenePainter::samples_for(unsigned wanted, bool is_changed) {
  is_hurried_ = is_changed && was_changed_ && (is_hurried_ || last_frame_s_ > kLongFrameSeconds);
  return supported(is_hurried_ ? 1 : wanted);
}

void ScenePainter::ensure(std::optional<render::SceneTarget>& target, VkExtent2D extent,
                          unsigned samples) {
  if (target && target->extent().width == extent.width &&
      target->extent().height == extent.height && target->samples() == samples)
    return;
  if (&target == &whole_) drawn_.reset();
  try {
    target.emplace(device_, extent, samples, format_);
  } catch (const gpu::OutOfMemoryError&) {
    if (samples == 1) throw;
    is_short_of_memory_ = true;
    target.emplace(device_, extent, 1U, format_);
  }
}

unsigned ScenePainter::supported(unsigned samples) const {
  return device_.supported_samples(is_short_of_memory_ ? 1 : samples);
}

bool ScenePainter::draw(VkCommandBuffer commands, VkExtent2D extent, SceneMirror& mirror,
                        const Document& document, const render::Camera& camera, double now_s) {
  measure(now_s);
  const Drawn now{mirror.settings(), camera};
  const bool is_changed = drawn_ != now;
  const bool heavy = is_heavy(mirror);
  if (heavy) is_hurried_ = false;  // it would want frames for ever
  const unsigned samples =
      heavy ? supported(now.settings.samples) : samples_for(now.settings.samples, is_changed);
  ensure(whole_, extent, samples);
  const bool starts = drawn_ != now;
  drawn_ = now;
  if (starts) {
    done_ = 0;
    work_ = render::Renderer::work(mirror.mesh(), now.settings);
  }
  if (heavy) ensure(quick_, extent, supported(1));
  const bool needs_more =
      heavy ? draw_heavy(commands, mirror, document, is_changed) : draw_light(commands, mirror);
  was_changed_ = is_changed;
  return needs_more || is_hurried_;
}

bool ScenePainter::draw_light(VkCommandBuffer commands, SceneMirror& mirror) {
  shows_quick_ = false;
  if (done_ == work_) return false;
  renderer_.draw(commands, *whole_, mirror.mesh(), drawn_->camera, drawn_->settings);
  last_work_ = work_ - done_;
  done_ = work_;
  return false;
}

bool ScenePainter::draw_heavy(VkCommandBuffer commands, SceneMirror& mirror,
                              const Document& document, bool is_changed) {
  if (is_changed) {
    // Without memory for a stand-in, the frame takes long.
    shows_quick_ = draw_stand_in(commands, document);
    return shows_quick_ || draw_light(commands, mirror);
  }
  if (done_ == work_) return false;
  const auto slice = static_cast<std::uint64_t>(triangles_per_second_ * kSliceSeconds);
  const std::uint64_t end = std::min(work_, done_ + std::max<std::uint64_t>(slice, 1));
  renderer_.draw_slice(commands, *whole_, mirror.mesh(), drawn_->camera, drawn_->settings,
                       {done_, end});
  last_work_ = end - done_;
  done_ = end;
  if (done_ == work_) shows_quick_ = false;
  return done_ < work_;
}

/// Returns false if there is no memory for it.
bool ScenePainter::draw_stand_in(VkCommandBuffer commands, const Document& document) {
  // There is no model yet that one could be made of.
  if (document.progressive.is_arriving() && !document.progressive.stand_in()) return false;
  // Some of its faces are folded over, which says nothing about the model.
  render::Settings settings = drawn_->settings;
  settings.back = settings.front;
  try {
    update_stand_in(document);
    // Its vertices are in split order only if it is a level.
    settings.colors_by_split_order &= stand_in_level_ != nullptr;
    if (document.progressive.is_on())
      settings.colored_splits = document.progressive.mesh().split_count();
    stand_in_mirror_->apply(stand_in_, settings);
  } catch (const gpu::LostError&) {
    throw;
  } catch (const Error&) {
    stand_in_mirror_.reset();
    stand_in_level_.reset();
    stand_in_of_ = 0;
    return false;
  }
  renderer_.draw(commands, *quick_, *stand_in_mirror_, drawn_->camera, settings);
  return true;
}

bool ScenePainter::is_stand_in_current(const Document& document) const {
  if (stand_in_of_ != document.opening || stand_in_level_ != document.progressive.stand_in())
    return false;
  return stand_in_level_ || is_similar(document.statistics.faces, stand_in_faces_);
}

void ScenePainter::update_stand_in(const Document& document) {
  if (is_stand_in_current(document)) return;
  const std::uint32_t faces = document.statistics.faces;
  std::shared_ptr<const Mesh> made = document.progressive.stand_in();
  if (!made && is_similar(faces, document.edits.opened_faces)) made = document.stand_in;
  if (!made) made = make_stand_in(document.model.mesh, document.statistics);
  stand_in_ = *made;
  stand_in_mirror_.emplace(device_);
  stand_in_level_ = document.progressive.stand_in();
  stand_in_of_ = document.opening;
  stand_in_faces_ = faces;
}

}  // namespace mesher::app
