#include "engine/render/look_pass.h"

#include <algorithm>
#include <vector>

namespace mesher::render {
namespace {

/// Returns how far away a point is, in view space. Only comparisons count.
float depth_of(const shared::ViewConstants& view, const glm::vec3& point) {
  return -glm::dot(glm::vec3(view.row_z), point - view.origin);
}

/// Returns the batches in the order in which a camera needs them: those that blend are at the end.
std::vector<Batch> ordered_batches(const LookFrame& frame) {
  std::vector<Batch> batches = frame.appearance.batches();
  const auto blended = std::stable_partition(batches.begin(), batches.end(),
                                             [](const Batch& b) { return !b.blends; });
  std::stable_sort(blended, batches.end(), [&](const Batch& a, const Batch& b) {
    return depth_of(frame.constants.view, a.center) > depth_of(frame.constants.view, b.center);
  });
  return batches;
}

void draw_faces(const LookFrame& frame, VkCullModeFlags culled, std::uint32_t first,
                std::uint32_t count) {
  vkCmdSetCullMode(frame.commands, culled);
  vkCmdDraw(frame.commands, 3 * count, 1, 3 * first, frame.section);
}

/// Returns whether a look shows what the material makes of the faces; otherwise all faces are
/// shown, from both sides.
bool shows_materials(Look look) {
  return look == Look::material || look == Look::base_color;
}

/// Draws a part of a batch, counted from its own first face.
void draw_batch(LookPipelines& pipelines, const LookFrame& frame, const Batch& batch,
                std::uint32_t first, std::uint32_t count) {
  const Look look = frame.appearance.look();
  const GpuMaterials& materials = frame.appearance.materials();
  const bool blends = batch.blends && shows_materials(look);
  vkCmdBindPipeline(
      frame.commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
      pipelines.get({look, frame.has_wire, blends, frame.constants.geomorph != 0}, frame.target));
  const VkDescriptorSet set = materials.set(batch.material);
  vkCmdBindDescriptorSets(frame.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.layout(), 0, 1,
                          &set, 0, nullptr);
  shared::LookConstants constants = frame.constants;
  constants.surface = frame.appearance.surface();
  constants.faces = frame.appearance.faces();
  vkCmdPushConstants(frame.commands, pipelines.layout(),
                     VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                     sizeof(constants), &constants);
  const bool is_two_sided = materials.is_two_sided(batch.material) || !shows_materials(look);
  // The far side of something transparent is seen through the near one.
  if (blends && is_two_sided) draw_faces(frame, VK_CULL_MODE_FRONT_BIT, batch.first + first, count);
  const bool shows_back = is_two_sided && !blends;
  draw_faces(frame, shows_back ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT, batch.first + first,
             count);
}

}  // namespace

void draw_look(LookPipelines& pipelines, const LookFrame& frame, std::uint32_t first,
               std::uint32_t count) {
  std::uint32_t begin = 0;  // of the batch, counted over all
  for (const Batch& batch : ordered_batches(frame)) {
    const std::uint32_t from = std::max(first, begin);
    const std::uint32_t to = std::min(first + count, begin + batch.count);
    if (from < to) draw_batch(pipelines, frame, batch, from - begin, to - from);
    begin += batch.count;
  }
}

}  // namespace mesher::render
