#pragma once

#include <cstdint>
#include <span>

#include "engine/gpu/handles.h"

namespace mesher::gpu {

/// Options in which the pipelines differ. The rest (triangles, counterclockwise front faces,
/// dynamic viewport and scissor) is the same for all.
struct PipelineOptions {
  std::span<const std::uint32_t> vertex_shader;    ///< SPIR-V
  std::span<const std::uint32_t> fragment_shader;  ///< empty: depth only
  /// Tightly packed vertex arrays, one per binding: location i reads binding i.
  std::span<const VkFormat> vertex_arrays;
  VkFormat color_format = VK_FORMAT_UNDEFINED;
  VkFormat depth_format = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  bool blends = false;  ///< premultiplied alpha over the existing content
  bool writes_depth = true;
  VkCompareOp depth_test = VK_COMPARE_OP_GREATER_OR_EQUAL;  ///< depth is reversed
  bool may_cull = false;  ///< draws set the cull mode (vkCmdSetCullMode); otherwise none is culled
};

/// Creates a layout. Shaders access their data by address, from push constants of
/// `push_constant_bytes` bytes that every stage sees, and textures by set 0, if there is one.
UniquePipelineLayout create_layout(Device& device, std::uint32_t push_constant_bytes,
                                   VkDescriptorSetLayout set = VK_NULL_HANDLE);

/// Creates a pipeline for dynamic rendering. Throws DeviceError.
UniquePipeline create_pipeline(Device& device, VkPipelineLayout layout,
                               const PipelineOptions& options);

}  // namespace mesher::gpu
