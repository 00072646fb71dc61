// Push constants, one definition for C++ and GLSL. std430 rules: vec4 and structs at multiples of
// 16 bytes, vec2 and addresses of 8. At most 128 bytes, the least that every device has.
#ifndef MESHER_SHADERS_CONSTANTS_H
#define MESHER_SHADERS_CONSTANTS_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
namespace mesher::render::shared {
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
using Address = std::uint64_t;
#else
#define Address uvec2
#endif

/// Camera::transform as shaders use it: see ViewTransform.
struct ViewConstants {
  vec4 row_x;  // a row of the rotation, and the offset
  vec4 row_y;
  vec4 row_z;
  vec4 projection;  // scale x, scale y (negative: y runs down in Vulkan), depth scale, depth offset
  vec3 origin;
  float perspective;  // 1 or 0
};

// Colors in 8 bits a component hold the square root of linear light: close to even steps for the
// eye, and undone by one multiplication.

// In MORPH variants `positions` is the address of GeomorphConstants instead, since push constants
// have no room left.

struct SurfaceConstants {
  ViewConstants view;
  Address positions;  // float[3] a vertex
  Address indices;    // uint a half-edge
  Address classes;    // 16 half-edges a uint
  Address normals;    // octahedral snorm16x2, a vertex or a half-edge
  uint front;
  uint back;
  uint line;         // alpha: strength where the mesh is not dense
  float line_width;  // pixels
};

struct LineConstants {
  ViewConstants view;
  Address positions;
  Address indices;
  Address lines;    // half-edge and weight (uint, float) of each edge to draw
  Address classes;  // as above
  uint color;
  float half_width;  // pixels
  vec2 viewport;     // pixels
};

/// What vertices are moved by while splits grow: see GeomorphTime and SplitMorph in
/// engine/mesh/geomorph.h. No push constants but a block in a buffer, the same for a whole frame.
struct GeomorphConstants {
  Address positions;
  Address heads;    // uint a vertex
  Address splits;   // SplitMorph, kSplitWords words each
  uint first_head;  // heads from here on grow: twice GeomorphTime::first_growing
  int whole;        // this and the next as in GeomorphTime
  float fraction;
  float rate;
  float fixed_share;
  uint first_split_vertex;  // the first vertex that came with a split
  float split_order_scale;  // one over how often those double the mesh; negative: it has one color
  uint unused;              // a multiple of 8 bytes
};

#ifdef __cplusplus
static_assert(sizeof(ViewConstants) == 80);
static_assert(sizeof(GeomorphConstants) == 56);
static_assert(sizeof(SurfaceConstants) == 128 && sizeof(LineConstants) == 128);
}  // namespace mesher::render::shared
#endif

#endif
