#include "app/files/picture_task.h"

#include <cmath>
#include <utility>

#include "app/document/shown.h"
#include "app/files/picture.h"
#include "app/files/turntable.h"
#include "engine/core/error.h"
#include "engine/io/image_decode.h"

namespace mesher::app {
namespace {

VkExtent2D shown_size(const View& view) {
  return {static_cast<std::uint32_t>(std::lround(view.size().x)),
          static_cast<std::uint32_t>(std::lround(view.size().y))};
}

template <class T>
Array<T> copied(std::span<const T> values) {
  return {values.begin(), values.end()};
}

render::Sources sources_of(const PictureTask& task) {
  render::Sources sources{.corner_normals = task.corner_normals,
                          .vertex_normals = task.vertex_normals,
                          .morph = {.heads = task.heads, .splits = task.splits}};
  sources.appearance.materials = task.materials;
  sources.appearance.morph = task.attribute_morph.view();
  sources.appearance.decode = [&task](std::span<const ImageRequest> images, const TakeImage& take) {
    std::vector<std::string> problems;  // the window has shown them
    io::decode_images(*task.materials, images, take, problems);
  };
  if (!task.attributes.is_empty()) sources.appearance.attributes = &task.attributes;
  if (!task.scene) return sources;
  sources.corner_normals = {};
  sources.appearance.attributes = &task.scene->attributes();
  sources.pose = task.scene->pose_source();
  return sources;
}

}  // namespace

std::string objection(const PictureRequest& request, const View& view) {
  const VkExtent2D size = shown_size(view);
  return request.turn ? turntable_objection(request.file, size, request.options, *request.turn)
                      : picture_objection(request.file, size, request.options);
}

PictureTask begin_picture(const Document& document, const View& view, PictureRequest request) {
  const render::Sources sources = shown_sources(document);
  const VkExtent2D size = shown_size(view);
  Image legend = legend_of_picture(shown_settings(view.settings, document), legend_facts(document),
                                   size, request.options);
  std::optional<ScenePicture> scene;
  if (shows_placed(document)) scene.emplace(document).pose(document);
  // The edges of copies have other numbers.
  const bool keeps_elements = !scene || scene->keeps_elements();
  const bool has_attributes = sources.appearance.attributes != nullptr && !scene;
  return {.request = std::move(request),
          .mesh = scene ? Mesh() : shown_mesh(document),
          .attributes = has_attributes ? *sources.appearance.attributes : Attributes(),
          .attribute_morph = document.progressive.is_on()
                                 ? document.progressive.levels().attribute_morph
                                 : progressive::AttributeMorph(),
          .materials = sources.appearance.materials,
          .scene = std::move(scene),
          .corner_normals = copied(sources.corner_normals),
          .vertex_normals = copied(sources.vertex_normals),
          .heads = copied(sources.morph.heads),
          .splits = copied(sources.morph.splits),
          .marked = keeps_elements ? marked_edges(document.creases) : render::MarkedEdges(),
          .settings = shown_settings(view.settings, document),
          .camera = view.camera,
          .box = document.statistics.box,
          .legend = std::move(legend),
          .width = size.width,
          .height = size.height,
          .device = {}};
}

void perform(PictureTask& task, Progress* progress) {
  const gpu::Instance instance({.extensions = {}, .validation = task.validation});
  {
    gpu::Device device(instance, {.select = task.device});
    render::GpuMesh mesh(device);
    mesh.apply(task.scene ? task.scene->mesh() : task.mesh, task.settings, sources_of(task));
    mesh.mark(task.marked);
    render::Renderer renderer(device);
    const PictureScene scene{.device = device,
                             .renderer = renderer,
                             .mesh = mesh,
                             .camera = task.camera,
                             .settings = task.settings,
                             .box = task.box,
                             .legend = task.legend,
                             .window = {task.width, task.height}};
    const PictureRequest& request = task.request;
    if (request.turn) {
      write_turntable(scene, request.options, *request.turn, request.file, progress);
    } else {
      write_picture(scene, request.options, request.file, progress);
    }
  }
  if (instance.messages().count() > 0) {
    throw DeviceError("validation: " + instance.messages().list().front());
  }
}

}  // namespace mesher::app
