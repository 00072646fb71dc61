// Push constants, one definition for C++ and GLSL. std430 rules: vec4 and structs are aligned to 16
// bytes, vec2 and addresses to 8. At most 128 bytes, the minimum that every device supports.
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

/// Camera::transform in the shaders' form: see ViewTransform.
struct ViewConstants {
  vec4 row_x;  // a row of the rotation, and the offset
  vec4 row_y;
  vec4 row_z;
  vec4 projection;  // scale x, scale y (negative: y runs down in Vulkan), depth scale, depth offset
  vec3 origin;
  float perspective;  // 1 or 0
};

// Colors in 8 bits per component store the square root of linear light. The steps look nearly even
// to the eye, and one multiplication decodes them.

// In MORPH variants, `positions` is the address of GeomorphConstants instead, because the push
// constants are full.

struct SurfaceConstants {
  ViewConstants view;
  Address positions;  // float[3] per vertex
  Address indices;    // uint per half-edge
  Address classes;    // 16 half-edges per uint
  Address normals;    // octahedral snorm16x2, per vertex or per half-edge
  uint front;         // its alpha byte: pixels of the picture per pixel of the window
  uint back;
  uint line;         // alpha: opacity where the mesh is not dense
  float line_width;  // pixels
};

struct LineConstants {
  ViewConstants view;
  Address positions;
  Address indices;
  Address lines;    // half-edge and weight (uint, float) of each edge to draw
  Address classes;  // as above
  uint color;
  float half_width;   // pixels
  uint picture;       // width and height in pixels, 16 bits each
  float pixel_ratio;  // pixels of the picture per pixel of the window
};

/// The data that moves vertices during a geomorph: see GeomorphTime and SplitMorph in
/// engine/mesh/geomorph.h. It is not in the push constants but in a buffer, and is the same for a
/// whole frame.
struct GeomorphConstants {
  Address positions;
  Address heads;    // uint per vertex
  Address splits;   // SplitMorph, kSplitWords words each
  uint first_head;  // first growing head: twice GeomorphTime::first_growing
  int whole;        // this and the next as in GeomorphTime
  float fraction;
  float rate;
  float fixed_share;
  uint first_split_vertex;  // the first vertex created by a split
  float split_order_scale;  // 1 / doublings of the mesh by these; negative: one color
  uint unused;              // pads to a multiple of 8 bytes
};

/// How much a vertex follows a matrix of the palette.
struct PoseInfluence {
  uint matrix;
  float weight;
};

/// The data that poses vertices. In POSED variants, `positions` is its address, as in MORPH ones.
struct PoseConstants {
  Address positions;
  Address influences;  // PoseInfluence, `per_vertex` for each vertex
  Address palette;     // vec4[3] per matrix: its rows
  uint per_vertex;     // 0: vertices stay where they are
  uint unused;
};

#ifdef __cplusplus
static_assert(sizeof(ViewConstants) == 80);
static_assert(sizeof(PoseInfluence) == 8 && sizeof(PoseConstants) == 32);
static_assert(sizeof(GeomorphConstants) == 56);
static_assert(sizeof(SurfaceConstants) == 128 && sizeof(LineConstants) == 128);
}  // namespace mesher::render::shared
#endif

#endif
