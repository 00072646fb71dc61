// A surface's vertices. Variants: GOURAUD passes normals on; PULLED takes no vertex input but the
// number of a half-edge, so that corners of one vertex can differ: in their barycentric coordinate,
// and (CORNER_NORMALS) in their normal.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

layout(push_constant) uniform Constants { SurfaceConstants constants; };

#ifndef PULLED
layout(location = 0) in vec3 in_position;
#ifdef GOURAUD
layout(location = 1) in vec2 in_normal;
#endif
#endif

#ifdef GOURAUD
layout(location = 1) out vec3 out_normal;
#else
layout(location = 0) out vec3 out_view;
#endif
#ifdef PULLED
layout(location = 2) out vec3 out_barycentric;
#endif

// The depth of one vertex must be the same bits in every pass.
invariant gl_Position;

#ifdef GOURAUD
// Inverse of encode_normal in engine/render/gpu_mesh.cpp (Q. Meyer et al., "On floating-point normal
// vectors", 2010).
vec3 decode_normal(vec2 e) {
  vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
  const float fold = max(-n.z, 0.0);
  n.x += n.x >= 0.0 ? -fold : fold;
  n.y += n.y >= 0.0 ? -fold : fold;
  return normalize(n);
}
#endif

#ifdef PULLED
// 1 at the corner, 0 along the opposite edge; where that edge is not an ordinary one, 1 all over, so
// that no line is drawn there: the line pass does.
vec3 barycentric(uint h) {
  const uint corner = h % 3;
  const uint first = h - corner;
  const uint shift = 2 * (first & 15);
  uint classes = Uints(constants.classes).at[first >> 4] >> shift;
  if (shift > 26) classes |= Uints(constants.classes).at[(first + 2) >> 4] << (32 - shift);
  vec3 b = vec3(0.0);
  b[corner] = 1.0;
  if ((classes & 3) != 0) b.z = 1.0;
  if ((classes & 12) != 0) b.x = 1.0;
  if ((classes & 48) != 0) b.y = 1.0;
  return b;
}
#endif

void main() {
#ifdef PULLED
  const uint h = gl_VertexIndex;
  const uint vertex = Uints(constants.indices).at[h];
  const vec3 position = fetch_position(constants.positions, vertex);
  out_barycentric = barycentric(h);
#else
  const vec3 position = in_position;
#endif
#ifdef GOURAUD
#if defined(CORNER_NORMALS)
  const vec2 encoded = unpackSnorm2x16(Uints(constants.normals).at[h]);
#elif defined(PULLED)
  const vec2 encoded = unpackSnorm2x16(Uints(constants.normals).at[vertex]);
#else
  const vec2 encoded = in_normal;
#endif
  const vec3 n = decode_normal(encoded);
  out_normal = vec3(dot(constants.view.row_x.xyz, n), dot(constants.view.row_y.xyz, n),
                    dot(constants.view.row_z.xyz, n));
#endif
  const vec3 in_view = to_view(constants.view, position);
#ifndef GOURAUD
  out_view = in_view;
#endif
  gl_Position = to_clip(constants.view, in_view);
}
