#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/document/document.h"
#include "app/document/picture_options.h"
#include "app/document/scene_picture.h"
#include "app/document/view.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/progressive/attribute_morph.h"
#include "engine/render/gpu_mesh.h"

namespace mesher::app {

/// A picture to write, or a turn of pictures.
struct PictureRequest {
  std::filesystem::path file;
  PictureOptions options;
  std::optional<TurntableOptions> turn;  ///< none: a still picture
};

/// Returns why the request cannot be carried out for what the view shows; empty if it can. Does not
/// look at the file system.
std::string objection(const PictureRequest& request, const View& view);

/// A request with a copy of everything that the picture shows, so that another thread can draw it
/// while the document changes.
struct PictureTask {
  PictureRequest request;
  Mesh mesh;
  Attributes attributes;  ///< none: the mesh is drawn as clay
  progressive::AttributeMorph attribute_morph;
  std::shared_ptr<const Materials> materials;  ///< as Model::materials
  /// What the scene of the model shows, which is drawn instead of the mesh.
  std::optional<ScenePicture> scene;
  Array<glm::vec3> corner_normals;  ///< this and the next three: render::Sources
  Array<std::uint32_t> vertex_normals;
  Array<std::uint32_t> heads;
  Array<SplitMorph> splits;
  render::MarkedEdges marked;
  render::Settings settings;
  render::Camera camera;
  Box box;       ///< of the model
  Image legend;  ///< as in PictureScene
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string device;       ///< as gpu::DeviceOptions::select
  bool validation = false;  ///< messages of the Vulkan validation layer are errors
};

/// Copies what the document shows, in the part of the window that the view gives it. O(V + F).
PictureTask begin_picture(const Document& document, const View& view, PictureRequest request);

/// Draws and writes the picture on a device of its own, so that it can run on any thread beside the
/// window. Pre: objection is empty. Throws OutputError, DeviceError, or Cancelled; then no file has
/// changed.
void perform(PictureTask& task, Progress* progress);

}  // namespace mesher::app
