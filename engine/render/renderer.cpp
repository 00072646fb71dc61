#include "engine/render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/packing.hpp>
#include <glm/vec4.hpp>

#include "engine/core/assert.h"
#include "engine/render/look_pass.h"
#include "shaders/shared/constants.h"

namespace mesher::render {
namespace {

/// Image height at which lines have their nominal width. Widths scale with the square root of the
/// height.
constexpr float kReferenceHeight = 600.0F;
constexpr float kEdgeWidth = 1.1F;
/// Up to this many faces, edges without a surface are drawn as quads. Drawn by their faces instead,
/// edges on the outline would have only one face, and half the width. Beyond this, edges are so
/// dense that it does not matter, and quads cost three times as much.
constexpr std::uint32_t kQuadFaces = 50'000;
constexpr float kBoundaryWidth = 4.6F;
/// Widths of the bands under marked edges: wide enough to be seen on both sides of a boundary.
constexpr float kSelectedWidth = 8.0F;
constexpr float kHoveredWidth = 7.5F;
constexpr float kEdgeStrength = 0.85F;
/// Opacity of lines without a surface: where they are visible, and where a surface would hide them.
/// Blending is linear, so the same opacity looks much stronger for light lines on dark than for
/// dark lines on light.
struct LoneStrength {
  float visible;
  float hidden;
};
constexpr LoneStrength kOnLight{1.0F, 0.25F};
constexpr LoneStrength kOnDark{0.65F, 0.07F};

glm::vec3 linear(const Color& color) {
  const auto decode = [](float c) {
    return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
  };
  return {decode(color.x), decode(color.y), decode(color.z)};
}

std::uint32_t pack(const Color& color, float alpha) {
  return glm::packUnorm4x8(glm::vec4(glm::sqrt(linear(color)), alpha));
}

/// Returns the factor of all line widths: that of the window, enlarged with the picture.
float line_scale(const PicturePart& part) {
  const auto ratio = static_cast<float>(part.pixel_ratio);
  const float height = static_cast<float>(part.picture.height) / ratio;
  return ratio * std::clamp(std::sqrt(height / kReferenceHeight), 0.75F, 3.0F);
}

shared::ViewConstants view_constants(const ViewTransform& view) {
  return {.row_x = {view.rows[0], view.offset.x},
          .row_y = {view.rows[1], view.offset.y},
          .row_z = {view.rows[2], view.offset.z},
          // y runs down in Vulkan's clip space
          .projection = {view.scale.x, -view.scale.y, view.depth_scale, view.depth_offset},
          .origin = view.origin,
          .perspective = view.perspective ? 1.0F : 0.0F};
}

/// Where a slice lies in the drawing of its scene.
struct SlicePlace {
  bool is_first = true;
  bool is_last = true;
};

VkRenderingAttachmentInfo attachment(const gpu::DeviceImage& image, VkImageLayout layout,
                                     bool is_first, bool is_stored) {
  VkRenderingAttachmentInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  info.imageView = image.view();
  info.imageLayout = layout;
  info.loadOp = is_first ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
  info.storeOp = is_stored ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
  return info;
}

/// Faces that follow one another.
struct FaceRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// Records the draws of one frame.
class Recording {
 public:
  Recording(VkCommandBuffer commands, ScenePipelines& pipelines, LookPipelines& look_pipelines,
            const SceneTarget& target, const GpuMesh& mesh, const Camera& camera,
            const PicturePart& part, const Section& section)
      : commands_(commands),
        pipelines_(pipelines),
        look_pipelines_(look_pipelines),
        target_(target),
        mesh_(mesh),
        part_(part),
        section_(section),
        view_(view_constants(camera.transform(
            static_cast<double>(part.picture.width) / part.picture.height, mesh.box()))),
        positions_(mesh.positions().address()) {}

  /// Makes later draws take vertices from `block`.
  void morph(VkDeviceAddress block) {
    positions_ = block;
    vertices_ = Vertices::morphed;
  }
  /// Makes later draws move vertices by the mesh's pose.
  void pose() {
    positions_ = mesh_.pose().block();
    vertices_ = Vertices::posed;
  }
  void begin(const Color& background, const SlicePlace& place = {});
  void end(const SlicePlace& place = {});
  /// Draws a part of the work. Pre: the rendering has begun.
  void scene(const Settings& settings, const WorkRange& range);
  void surface(Pass pass, const Settings& settings, const FaceRange& faces,
               float line_strength = kEdgeStrength);
  /// Draws faces with their materials.
  void look(const Settings& settings, const FaceRange& faces);
  void edges(Pass pass, const Settings& settings, float strength);
  /// Draws marked edges, and creases and boundaries on top of them.
  void lines(Pass pass, const Settings& settings, float strength);

 private:
  void pass(std::uint32_t number, const Settings& settings, const FaceRange& faces);
  void lone_edges(Pass by_quads, Pass by_faces, const Settings& settings, const FaceRange& faces,
                  float strength);

  struct LineList {
    VkDeviceAddress lines;  ///< 0: every half-edge
    std::uint32_t count;
  };

  void bind(Pass pass) {
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      pipelines_.get(pass, vertices_, target_));
  }
  template <class Constants>
  void push(const Constants& constants) {
    vkCmdPushConstants(commands_, pipelines_.layout(),
                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                       sizeof(constants), &constants);
  }
  void draw_lines(LineList list, const Color& color, float width, float strength);

  VkCommandBuffer commands_;
  ScenePipelines& pipelines_;
  LookPipelines& look_pipelines_;
  const SceneTarget& target_;
  const GpuMesh& mesh_;
  const PicturePart& part_;
  const Section& section_;
  shared::ViewConstants view_;
  VkDeviceAddress positions_;  ///< address for the shaders: positions, or GeomorphConstants
  Vertices vertices_ = Vertices::still;
};

void Recording::begin(const Color& background, const SlicePlace& place) {
  const bool resolves = static_cast<bool>(target_.multisampled());
  const gpu::DeviceImage& drawn = resolves ? target_.multisampled() : target_.color();
  const bool writes_color = !resolves || place.is_last;
  const auto prepare = [&](const gpu::DeviceImage& image, const gpu::ImageState& use, bool is_new,
                           VkImageAspectFlags aspect) {
    gpu::transition(commands_, image.handle(), is_new ? gpu::kUndefined : use, use, aspect);
  };
  prepare(drawn, gpu::kColorAttachment, place.is_first, VK_IMAGE_ASPECT_COLOR_BIT);
  if (resolves && writes_color)
    prepare(target_.color(), gpu::kColorAttachment, true, VK_IMAGE_ASPECT_COLOR_BIT);
  prepare(target_.depth(), gpu::kDepthAttachment, place.is_first, VK_IMAGE_ASPECT_DEPTH_BIT);

  VkRenderingAttachmentInfo color =
      attachment(drawn, gpu::kColorAttachment.layout, place.is_first, !resolves || !place.is_last);
  const glm::vec3 clear = linear(background);
  if (!part_.is_transparent) color.clearValue.color = {{clear.x, clear.y, clear.z, 1.0F}};
  if (resolves && place.is_last) {
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = target_.color().view();
    color.resolveImageLayout = gpu::kColorAttachment.layout;
  }
  VkRenderingAttachmentInfo depth =
      attachment(target_.depth(), gpu::kDepthAttachment.layout, place.is_first, !place.is_last);
  depth.clearValue.depthStencil = {0.0F, 0};

  const VkExtent2D extent = target_.extent();
  VkRenderingInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  info.renderArea.extent = extent;
  info.layerCount = 1;
  info.colorAttachmentCount = 1;
  info.pColorAttachments = &color;
  info.pDepthAttachment = &depth;
  vkCmdBeginRendering(commands_, &info);
  vkCmdSetViewport(commands_, 0, 1, &section_.viewport);
  vkCmdSetScissor(commands_, 0, 1, &info.renderArea);
}

void Recording::end(const SlicePlace& place) {
  vkCmdEndRendering(commands_);
  if (!place.is_last) return;
  gpu::transition(commands_, target_.color().handle(), gpu::kColorAttachment, gpu::kTransferSource);
}

void Recording::surface(Pass pass, const Settings& settings, const FaceRange& faces,
                        float line_strength) {
  bind(pass);
  push(shared::SurfaceConstants{
      .view = view_,
      .positions = positions_,
      .indices = mesh_.indices().address(),
      .classes = mesh_.classes().address(),
      .normals = mesh_.normals().buffer().address(),
      .front = pack(settings.front, static_cast<float>(part_.pixel_ratio) / 255.0F),
      .back = pack(settings.back, 1.0F),
      .line = pack(edge_color(settings), line_strength),
      .line_width = kEdgeWidth * line_scale(part_)});
  if (!is_indexed(pass)) {
    vkCmdDraw(commands_, 3 * faces.count, 1, 3 * faces.first, section_.code);
    return;
  }
  const std::array buffers{mesh_.positions().handle(), mesh_.normals().buffer().handle()};
  constexpr std::array<VkDeviceSize, 2> kOffsets{};
  vkCmdBindVertexBuffers(commands_, 0, pass == Pass::gouraud ? 2 : 1, buffers.data(),
                         kOffsets.data());
  vkCmdBindIndexBuffer(commands_, mesh_.indices().handle(), 0, VK_INDEX_TYPE_UINT32);
  vkCmdDrawIndexed(commands_, 3 * faces.count, 1, 3 * faces.first, 0, section_.code);
}

void Recording::look(const Settings& settings, const FaceRange& faces) {
  shared::LookConstants constants{};
  constants.view = view_;
  constants.line = pack(edge_color(settings), kEdgeStrength);
  constants.line_width = kEdgeWidth * line_scale(part_);
  constants.front = pack(settings.front, static_cast<float>(part_.pixel_ratio) / 255.0F);
  if (vertices_ == Vertices::morphed) constants.geomorph = positions_;
  draw_look(look_pipelines_,
            {.commands = commands_,
             .target = target_,
             .appearance = mesh_.appearance(),
             .constants = constants,
             .has_wire = settings.wireframe,
             .section = section_.code},
            faces.first, faces.count);
}

void Recording::edges(Pass pass, const Settings& settings, float strength) {
  bind(pass);
  draw_lines({.lines = 0, .count = mesh_.halfedge_count()}, edge_color(settings), kEdgeWidth,
             strength);
}

void Recording::lines(Pass pass, const Settings& settings, float strength) {
  const std::uint32_t creases = mesh_.crease_count();
  const std::uint32_t boundaries = mesh_.boundary_count();
  const std::uint32_t selected = mesh_.selected_count();
  const std::uint32_t hovered = mesh_.has_hovered() ? 1 : 0;
  if (creases + boundaries + selected + hovered == 0) return;
  bind(pass);
  const VkDeviceAddress marks = mesh_.marks().address();
  draw_lines({marks, selected}, settings.selected, kSelectedWidth, strength);
  draw_lines({marks + selected * sizeof(Line), hovered}, settings.hovered, kHoveredWidth, strength);
  draw_lines({mesh_.creases().address(), creases}, settings.crease, kCreaseWidth, strength);
  draw_lines({mesh_.boundaries().address(), boundaries}, settings.boundary, kBoundaryWidth,
             strength);
}

void Recording::draw_lines(LineList list, const Color& color, float width, float strength) {
  if (list.count == 0) return;
  constexpr std::uint32_t kVerticesPerLine = 6;
  push(shared::LineConstants{.view = view_,
                             .positions = positions_,
                             .indices = mesh_.indices().address(),
                             .lines = list.lines,
                             .classes = mesh_.classes().address(),
                             .color = pack(color, strength),
                             .half_width = 0.5F * width * line_scale(part_),
                             .picture = part_.picture.width | part_.picture.height << 16,
                             .pixel_ratio = static_cast<float>(part_.pixel_ratio)});
  vkCmdDraw(commands_, kVerticesPerLine * list.count, 1, 0, section_.code);
}

Pass surface_pass(const GpuMesh& mesh, const Settings& settings) {
  const GpuNormals::Mode normals = mesh.normals().mode();
  if (settings.shading == Shading::flat || normals == GpuNormals::Mode::none) {
    return settings.wireframe ? Pass::flat_wire : Pass::flat;
  }
  if (normals == GpuNormals::Mode::corner) {
    return settings.wireframe ? Pass::gouraud_corner_wire : Pass::gouraud_corner;
  }
  return settings.wireframe ? Pass::gouraud_wire : Pass::gouraud;
}

/// The number of times that the triangles of the mesh are drawn. Without a surface: depth, hidden
/// edges, visible edges.
std::uint32_t pass_count(const Settings& settings) {
  return settings.shading == Shading::none ? 3 : 1;
}

/// Hidden lines are drawn faintly too, so that one can see through the mesh without mistaking back
/// for front.
void Recording::lone_edges(Pass by_quads, Pass by_faces, const Settings& settings,
                           const FaceRange& faces, float strength) {
  if (mesh_.face_count() > kQuadFaces) return surface(by_faces, settings, faces, strength);
  // Few faces are one slice.
  edges(by_quads, settings, strength);
}

void Recording::pass(std::uint32_t number, const Settings& settings, const FaceRange& faces) {
  const bool is_end = faces.first + faces.count == mesh_.face_count();
  if (settings.shading != Shading::none) {
    const bool is_clay = settings.colors_by_split_order || mesh_.appearance().look() == Look::clay;
    if (is_clay) {
      surface(surface_pass(mesh_, settings), settings, faces);
    } else {
      look(settings, faces);
    }
    if (is_end && (settings.wireframe || settings.line_edges))
      lines(Pass::line_visible, settings, 1.0F);
    return;
  }
  const LoneStrength strength = settings.background == Background::light ? kOnLight : kOnDark;
  if (number == 0) {
    surface(Pass::depth, settings, faces);
  } else if (number == 1) {
    lone_edges(Pass::edge_hidden, Pass::wire_hidden, settings, faces, strength.hidden);
    if (is_end) lines(Pass::line_hidden, settings, 1.5F * strength.hidden);
  } else {
    lone_edges(Pass::edge_visible, Pass::wire_visible, settings, faces, strength.visible);
    if (is_end) lines(Pass::line_visible, settings, 1.0F);
  }
}

void Recording::scene(const Settings& settings, const WorkRange& range) {
  const std::uint64_t faces = mesh_.face_count();
  for (std::uint32_t number = 0; faces > 0 && number < pass_count(settings); ++number) {
    const std::uint64_t begin = std::max(range.begin, number * faces);
    const std::uint64_t end = std::min(range.end, (number + 1) * faces);
    if (begin >= end) continue;
    pass(number, settings,
         {static_cast<std::uint32_t>(begin - number * faces),
          static_cast<std::uint32_t>(end - begin)});
  }
}

}  // namespace

void Renderer::draw(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
                    const Camera& camera, const Settings& settings) {
  draw(commands, target, mesh, camera, settings, {.picture = target.extent()});
}

void Renderer::draw(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
                    const Camera& camera, const Settings& settings, const PicturePart& part) {
  draw_slice(commands, target, mesh, camera, settings, {0, work(mesh, settings)}, part);
}

void Renderer::draw_slice(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
                          const Camera& camera, const Settings& settings, const WorkRange& slice) {
  draw_slice(commands, target, mesh, camera, settings, slice, {.picture = target.extent()});
}

void Renderer::draw_slice(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
                          const Camera& camera, const Settings& settings, const WorkRange& slice,
                          const PicturePart& part) {
  MESHER_ASSERT(slice.begin < slice.end);
  const Section section = section_of(part, target.extent(), largest_viewport_);
  Recording recording(commands, pipelines_, look_pipelines_, target, mesh, camera, part, section);
  if (mesh.face_count() > 0 && needs_geomorph(mesh, settings)) {
    recording.morph(geomorph_.write(commands, mesh, settings));
  } else if (!mesh.pose().is_empty()) {
    recording.pose();
  }
  const SlicePlace place{.is_first = slice.begin == 0,
                         .is_last = slice.end >= work(mesh, settings)};
  recording.begin(background_color(settings.background), place);
  recording.scene(settings, slice);
  recording.end(place);
}

std::uint64_t Renderer::work(const GpuMesh& mesh, const Settings& settings) {
  return std::max<std::uint64_t>(1, std::uint64_t{mesh.face_count()} * pass_count(settings));
}

void Renderer::draw_bare(VkCommandBuffer commands, const SceneTarget& target, const GpuMesh& mesh,
                         const Camera& camera, const Settings& settings) {
  const PicturePart whole{.picture = target.extent()};
  const Section section = section_of(whole, target.extent(), largest_viewport_);
  Recording recording(commands, pipelines_, look_pipelines_, target, mesh, camera, whole, section);
  recording.begin(background_color(settings.background));
  if (mesh.face_count() > 0) recording.surface(Pass::bare, settings, {0, mesh.face_count()});
  recording.end();
}

}  // namespace mesher::render
