// The colors of split order, one definition for C++ and GLSL.
#ifndef MESHER_SHADERS_SPLIT_ORDER_H
#define MESHER_SHADERS_SPLIT_ORDER_H

#ifdef __cplusplus
#include <glm/vec3.hpp>
namespace mesher::render::shared {
using glm::vec3;
#define MESHER_SHADER_FUNCTION inline
#else
#define MESHER_SHADER_FUNCTION
#endif

// Returns the linear color at `share` of the way from the first split (0) to the last (1). It is a
// polynomial approximation of viridis (S. van der Walt, N. Smith, 2015), whose lightness rises
// evenly.
MESHER_SHADER_FUNCTION vec3 split_order_ramp(float share) {
  const float t = 0.12f + 0.88f * share;
  const vec3 c0 = vec3(0.2777273272f, 0.0054073445f, 0.3340998053f);
  const vec3 c1 = vec3(0.1050930431f, 1.4046135299f, 1.3845901627f);
  const vec3 c2 = vec3(-0.3308618287f, 0.2148475595f, 0.0950951630f);
  const vec3 c3 = vec3(-4.6342304989f, -5.7991009733f, -19.3324409563f);
  const vec3 c4 = vec3(6.2282699363f, 14.1799333668f, 56.6905526007f);
  const vec3 c5 = vec3(4.7763849977f, -13.7451453777f, -65.3530326334f);
  const vec3 c6 = vec3(-5.4354558559f, 4.6458526122f, 26.3124352496f);
  const vec3 root = c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * (c5 + t * c6)))));
  return root * root;
}

#ifdef __cplusplus
#undef MESHER_SHADER_FUNCTION
}  // namespace mesher::render::shared
#endif

#endif
