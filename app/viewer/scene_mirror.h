#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/document/document.h"
#include "app/document/scene_picture.h"
#include "app/document/view.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/settings.h"
#include "engine/scene/placed.h"

namespace mesher::app {

/// Returns the rectangle of a picture of this size that shows the model. It is never empty, and
/// lies inside the picture.
VkRect2D model_rectangle(const View& view, const VkExtent2D& extent);

/// The GPU's copy of what a document shows. The window and scripts keep it up to date the same way.
class SceneMirror {
 public:
  explicit SceneMirror(gpu::Device& device) : mesh_(device) {}

  /// Uploads what has changed since the last call. `chosen`: the settings of the view. Returns
  /// whether the picture changes. `picture`: the only one that is drawn, if there is only one.
  /// Throws DeviceError if memory runs out. O(changed bytes); O(V + F) for another model.
  bool update(Document& document, const render::Settings& chosen,
              const std::optional<render::PictureView>& picture = {});
  /// Makes the next update upload everything.
  void invalidate() { mesh_.invalidate(); }

  render::GpuMesh& mesh() { return mesh_; }
  /// The settings that the last update was made for. Pre: there was one.
  const render::Settings& settings() const { return *settings_; }
  /// The last upload that was not empty.
  const render::UploadStats& last_upload() const { return last_upload_; }
  /// What cannot be drawn of the model, a line for each.
  std::vector<std::string> not_drawn() const;

 private:
  bool place(const Document& document);

  render::GpuMesh mesh_;
  /// What the scene of the model shows, if that is not the model itself, and what it was made of.
  struct Placed {
    ScenePicture picture;
    std::uint64_t generation = 0;
    std::uint64_t revision = 0;
    scene::HiddenNodes hidden;
    Playback playback;
  };
  std::optional<Placed> placed_;
  render::UploadStats last_upload_;
  std::optional<render::Settings> settings_;
  std::shared_ptr<const Materials> materials_;  ///< of the last update
  std::vector<std::string> not_decoded_;        ///< of not_drawn()
  std::uint64_t generation_ = 0;
};

}  // namespace mesher::app
