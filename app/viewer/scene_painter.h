#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "app/document/document.h"
#include "app/viewer/scene_mirror.h"
#include "engine/render/renderer.h"

namespace mesher::app {

/// Draws the scene of a window, so that no frame takes long. A scene that takes longer than
/// kFrameSeconds is drawn in slices, one per frame, while the picture does not change. When it
/// changes, the finished slices are dropped, and a coarse stand-in of the mesh is shown meanwhile:
/// a level of the progressive mesh if there is one, otherwise a clustering. Lighter scenes are
/// drawn whole, with one sample per pixel while they change in frames that take long.
class ScenePainter {
 public:
  static constexpr double kFrameSeconds = 0.033;

  ScenePainter(gpu::Device& device, VkFormat format);

  /// Call when the mesh has changed. The next picture is drawn from the beginning.
  void invalidate();
  /// Records the next step into the image. `now_s`: time of the frame. Pre: the mirror is up to
  /// date. Returns whether more frames are needed until the picture is finished.
  bool draw(VkCommandBuffer commands, VkExtent2D extent, SceneMirror& mirror,
            const Document& document, const render::Camera& camera, double now_s);
  /// The image to show. Pre: `draw` was called.
  const render::SceneTarget& image() const { return shows_quick_ ? *quick_ : *whole_; }
  /// Returns whether the image shows all of the last `draw`.
  bool is_finished() const { return !shows_quick_ && done_ == work_; }
  render::Renderer& renderer() { return renderer_; }

 private:
  /// What an image was drawn for.
  struct Drawn {
    render::Settings settings;
    render::Camera camera;
    friend bool operator==(const Drawn&, const Drawn&) = default;
  };

  void measure(double now_s);
  bool is_heavy(SceneMirror& mirror) const;
  unsigned samples_for(unsigned wanted, bool is_changed);
  unsigned supported(unsigned samples) const;
  void ensure(std::optional<render::SceneTarget>& target, VkExtent2D extent, unsigned samples);
  bool draw_light(VkCommandBuffer commands, SceneMirror& mirror);
  bool draw_heavy(VkCommandBuffer commands, SceneMirror& mirror, const Document& document,
                  bool is_changed);
  bool draw_stand_in(VkCommandBuffer commands, const Document& document);
  void update_stand_in(const Document& document);
  bool is_stand_in_current(const Document& document) const;

  gpu::Device& device_;
  VkFormat format_;
  render::Renderer renderer_;
  std::optional<render::SceneTarget> whole_;
  std::optional<render::SceneTarget> quick_;  ///< of the stand-in
  std::optional<Drawn> drawn_;                ///< what `whole_` is drawn for
  std::uint64_t done_ = 0;                    ///< of `work_`, in `whole_`
  std::uint64_t work_ = 0;
  bool shows_quick_ = false;

  // The stand-in, and the mesh that it was made of.
  Mesh stand_in_;
  std::optional<render::GpuMesh> stand_in_mirror_;
  std::shared_ptr<const Mesh> stand_in_level_;  ///< ProgressiveView::stand_in; null: a clustering
  std::uint64_t stand_in_of_ = 0;               ///< Document::opening
  std::uint32_t stand_in_faces_ = 0;            ///< of the mesh

  // Speed, measured in frames that follow one another.
  double triangles_per_second_;
  double last_s_ = 0.0;
  double last_frame_s_ = 0.0;
  std::uint64_t last_work_ = 0;  ///< of the last frame; 0: its time says nothing
  bool was_changed_ = false;
  bool is_hurried_ = false;          ///< one sample per pixel
  bool is_short_of_memory_ = false;  ///< for more than one sample per pixel
};

}  // namespace mesher::app
