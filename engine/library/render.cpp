#include <mesher/error.h>
#include <mesher/render.h>

#include <glm/trigonometric.hpp>

#include "engine/gpu/device.h"
#include "engine/gpu/instance.h"
#include "engine/io/image_decode.h"
#include "engine/io/png.h"
#include "engine/library/asset_data.h"
#include "engine/library/watch.h"
#include "engine/mesh/statistics.h"
#include "engine/render/picture.h"
#include "engine/render/renderer.h"

namespace mesher {

struct Renderer::Device {
  explicit Device(const std::string& name) : device(instance, {.select = name}) {}

  gpu::Instance instance;
  gpu::Device device;
  render::Renderer renderer{device};
};

namespace {

constexpr std::uint32_t kMostRenderSide = 16'384;

void check_options(const RenderOptions& options) {
  const auto is_side = [](std::uint32_t side) { return side >= 1 && side <= kMostRenderSide; };
  if (!is_side(options.width) || !is_side(options.height))
    throw UsageError("render: a side of the picture is not 1 to 16384 pixels");
  if (options.supersample < 1 || options.supersample > render::kMostSupersample)
    throw UsageError("render: supersample is not 1 to 3");
  if (!(options.zoom > 0.0)) throw UsageError("render: zoom is not above 0");
}

render::Settings engine_settings(const RenderOptions& options) {
  static_assert(int(Shading::gouraud) == int(render::Shading::gouraud));
  static_assert(int(Look::uv_checker) == int(render::Look::uv_checker));
  render::Settings settings;
  settings.shading = static_cast<render::Shading>(options.shading);
  settings.look = static_cast<render::Look>(options.look);
  // Without surface and wireframe the picture would be empty.
  settings.wireframe = options.wireframe || options.shading == Shading::none;
  settings.crease_angle_deg = options.crease_angle_deg;
  if (options.dark_background) settings.background = render::Background::dark;
  return settings;
}

render::Camera engine_camera(const RenderOptions& options, const Box& box) {
  render::Camera camera;
  camera.set_angles(glm::radians(options.yaw_deg), glm::radians(options.pitch_deg));
  camera.set_orthographic(options.orthographic);
  camera.frame(box, double(options.width) / options.height);
  camera.zoom(options.zoom);
  return camera;
}

}  // namespace

Renderer::Renderer(const std::string& device) : device_(std::make_unique<Device>(device)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

std::string Renderer::device() const {
  return device_->device.name();
}

Picture Renderer::render(const Asset& asset, const RenderOptions& options) {
  check_options(options);
  const Model& model = asset.data_->model;
  if (model.mesh.face_count() == 0) throw InputError("render: the model has no faces");
  Watch watch(options.progress);
  const render::Settings settings = engine_settings(options);
  const render::Camera camera = engine_camera(options, bounding_box(model.mesh));
  const glm::uvec2 drawn = options.supersample * glm::uvec2(options.width, options.height);

  Picture picture;
  const auto decode = [&](std::span<const ImageRequest> images, const TakeImage& take) {
    io::decode_images(*model.materials, images, take, picture.problems, watch.progress());
  };
  Mesh mesh = model.mesh;  // the GPU's copy takes note of the changes of its own mesh
  render::GpuMesh mirror(device_->device);
  mirror.apply(mesh, settings,
               {.appearance = {.attributes = &model.attributes,
                               .materials = model.materials,
                               .decode = decode,
                               .picture = render::PictureView{camera, drawn}}});
  const Image image =
      render::draw_picture(device_->device, device_->renderer, mirror, camera, settings,
                           {.window = {options.width, options.height},
                            .supersample = options.supersample,
                            .is_transparent = options.transparent,
                            .progress = watch.progress()});
  for (std::string& problem : mirror.appearance().problems())
    picture.problems.push_back(std::move(problem));
  picture.width = image.width;
  picture.height = image.height;
  picture.rgba.assign(image.rgba.begin(), image.rgba.end());
  return picture;
}

void Picture::save(const std::filesystem::path& file) const {
  Image image{.width = width, .height = height, .rgba = {}};
  image.rgba.assign(rgba.begin(), rgba.end());
  io::write_png(file, image);
}

}  // namespace mesher
