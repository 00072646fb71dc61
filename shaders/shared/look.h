// The data of a surface that is drawn with materials, one definition for C++ and GLSL. std430 rules
// as in constants.h.
#ifndef MESHER_SHADERS_LOOK_H
#define MESHER_SHADERS_LOOK_H

#include "constants.h"

#ifdef __cplusplus
namespace mesher::render::shared {
#define MESHER_SHADER_CONSTANT constexpr uint
#else
#define MESHER_SHADER_CONSTANT const uint
#endif

MESHER_SHADER_CONSTANT kTexcoordSets = 4;  // TEXCOORD_0 to TEXCOORD_3

/// An attribute layer: AttributeLayer in engine/mesh/attributes.h, byte for byte.
struct LayerConstants {
  Address values;
  uint stride;  // bytes per value
  uint format;  // components, 8 * ComponentType, 64 if normalized; 0: there is no such layer
};

// Bits of SurfaceBlock::flags.
MESHER_SHADER_CONSTANT kVertexNormals = 1;  // `normals` has one normal per vertex
MESHER_SHADER_CONSTANT kCornerNormals = 2;  // `normals` has one normal per half-edge
MESHER_SHADER_CONSTANT kLinearColors = 4;   // colors of vertices are linear rather than sRGB
MESHER_SHADER_CONSTANT kHasSeams = 8;       // `wedges` has the wedge of each half-edge

/// The arrays of a mesh with attributes. Attributes have a value per wedge.
struct SurfaceBlock {
  Address positions;  // this and the next three as in SurfaceConstants
  Address indices;
  Address classes;
  Address normals;
  Address wedges;  // uint per half-edge
  PoseConstants pose;
  uint flags;
  uint change_stride;    // this and the next two: WedgeMorph; 0: attributes do not move
  Address change_heads;  // uint per wedge
  Address changes;       // words
  LayerConstants normal;
  LayerConstants tangent;
  LayerConstants color;
  LayerConstants texcoord[kTexcoordSets];
  uint normal_change;  // first words of the layers in a change; 0: the layer does not move
  uint tangent_change;
  uint color_change;
  uint texcoord_change[kTexcoordSets];
  uint unused;
};

// The textures of a material, by their binding.
MESHER_SHADER_CONSTANT kBaseColorTexture = 0;
MESHER_SHADER_CONSTANT kMetallicRoughnessTexture = 1;
MESHER_SHADER_CONSTANT kNormalTexture = 2;
MESHER_SHADER_CONSTANT kOcclusionTexture = 3;
MESHER_SHADER_CONSTANT kEmissionTexture = 4;
MESHER_SHADER_CONSTANT kTextureCount = 5;

/// How a material uses a texture: its coordinates are matrix * uv + offset.
struct TextureUse {
  vec4 matrix;  // two columns
  vec2 offset;
  uint slot;       // which of the two sets that the vertex shader passes on; 2: there is no texture
  float strength;  // as Texture::strength
};

// Bits of MaterialBlock::flags.
MESHER_SHADER_CONSTANT kMasksAlpha = 1;
MESHER_SHADER_CONSTANT kBlendsAlpha = 2;
MESHER_SHADER_CONSTANT kIsUnlit = 4;

/// Material in engine/mesh/material.h. It is a uniform block, and not read by its address: llvmpipe
/// of Mesa 22.3 reads zeros by address for the pixels beside a triangle, and so takes wrong
/// differences between texture coordinates that depend on what was read.
struct MaterialBlock {
  vec4 base_color;
  vec3 emission;
  float metallic;
  float roughness;
  float alpha_cutoff;
  uint flags;
  uint sets;  // the sets of the two slots, 8 bits each
  TextureUse textures[kTextureCount];
  vec4 unused[3];  // blocks start at multiples of 256 bytes, which suits every device
};

/// Push constants.
struct LookConstants {
  ViewConstants view;
  Address surface;  // SurfaceBlock
  Address faces;    // uint per drawn face; 0: faces are drawn in their order
  uint line;        // this and the next two as in SurfaceConstants
  float line_width;
  uint front;
  uint unused;
  Address geomorph;  // GeomorphConstants, in MORPH variants
  uint padding[2];
};

#ifdef __cplusplus
static_assert(sizeof(SurfaceBlock) == 96 + 7 * 16 + 32);
static_assert(sizeof(MaterialBlock) == 256);
static_assert(sizeof(LookConstants) == 128);
}  // namespace mesher::render::shared
#endif

#endif
