#pragma once

#include <cstdint>
#include <span>

#include "engine/gpu/handles.h"

namespace mesher::gpu {

/// What differs between our pipelines; the rest (triangles, no culling, counter-clockwise fronts,
/// dynamic viewport and scissor) is the same for all.
struct PipelineOptions {
  std::span<const std::uint32_t> vertex_shader;    ///< SPIR-V
  std::span<const std::uint32_t> fragment_shader;  ///< empty: depth only
  /// Tightly packed vertex arrays, one binding each: location i reads binding i.
  std::span<const VkFormat> vertex_arrays;
  VkFormat color_format = VK_FORMAT_UNDEFINED;
  VkFormat depth_format = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  bool blends = false;  ///< premultiplied alpha over what is there
  bool writes_depth = true;
  VkCompareOp depth_test = VK_COMPARE_OP_GREATER_OR_EQUAL;  ///< depth is reversed
};

/// A layout without descriptors: shaders reach their data by address, from push constants of
/// `bytes` bytes that every stage sees.
UniquePipelineLayout create_layout(Device& device, std::uint32_t push_constant_bytes);

/// For dynamic rendering. Throws DeviceError.
UniquePipeline create_pipeline(Device& device, VkPipelineLayout layout,
                               const PipelineOptions& options);

}  // namespace mesher::gpu
