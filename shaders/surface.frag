// Pixels of a surface. Variants: GOURAUD (interpolated normals; otherwise the face's own), WIRE
// (ordinary edges on the surface), WIRE_ALONE (only the edges), TINT (one color per vertex).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "light.glsl"
#include "shared/constants.h"

layout(push_constant) uniform Constants { SurfaceConstants constants; };

#if defined(GOURAUD)
layout(location = 1) in vec3 in_normal;
#else
layout(location = 0) in vec3 in_view;
#endif
#if defined(WIRE) || defined(WIRE_ALONE)
layout(location = 2) in vec3 in_barycentric;
#endif
#ifdef TINT
layout(location = 3) in vec3 in_tint;
#endif

layout(location = 0) out vec4 out_color;

#if defined(WIRE) || defined(WIRE_ALONE)
// Returns how much of the pixel ordinary edges cover. Lines closer together than a few pixels of
// the window fade to `least`; at full strength they would only look dark.
float line_coverage(float least) {
  const vec3 dx = dFdx(in_barycentric);
  const vec3 dy = dFdy(in_barycentric);
  const vec3 altitude = inversesqrt(max(dx * dx + dy * dy, 1e-12));  // pixels from edge to corner
  const vec3 away = abs(in_barycentric) * altitude;
  const vec3 covered = clamp(0.5 * constants.line_width + 0.5 - away, 0.0, 1.0);
  // Side of a square with twice the triangle's area, computed from whichever two coordinates vary.
  const vec3 inverse_area = abs(cross(dx, dy));
  const float pixel_ratio = float(constants.front >> 24);
  const float spacing =
      inversesqrt(max(max(inverse_area.x, max(inverse_area.y, inverse_area.z)), 1e-12)) /
      pixel_ratio;
  return max(covered.x, max(covered.y, covered.z)) * clamp((spacing - 1.0) / 7.0, least, 1.0);
}
#endif

#ifndef GOURAUD
// Window y runs down, so with this order of factors the normal faces the viewer for either winding.
vec3 face_normal() { return normalize(cross(dFdy(in_view), dFdx(in_view))); }
#endif

#ifndef WIRE_ALONE
vec3 surface_color() {
  const vec3 plain = decode_color(gl_FrontFacing ? constants.front : constants.back);
#ifdef TINT
  return gl_FrontFacing && in_tint.x >= 0.0 ? in_tint : plain;
#else
  return plain;
#endif
}
#endif

void main() {
#ifdef WIRE_ALONE
  // Where edges are too dense to be distinguished, their tone still shows the shape: darker where
  // the surface turns away.
  const float alpha = line_coverage(mix(0.65, 0.20, face_normal().z)) * unpackUnorm4x8(constants.line).a;
  out_color = vec4(alpha * decode_color(constants.line), alpha);
#else
#ifdef GOURAUD
  const vec3 n = normalize(gl_FrontFacing ? in_normal : -in_normal);
#else
  const vec3 n = face_normal();
#endif
  vec3 color = shade(n, surface_color());
#ifdef WIRE
  color = mix(color, decode_color(constants.line),
              line_coverage(0.08) * unpackUnorm4x8(constants.line).a);
#endif
  out_color = vec4(color, 1.0);
#endif
}
