// Pixels of a surface. Variants: GOURAUD (interpolated normals; otherwise the face's own), WIRE
// (ordinary edges on the surface), WIRE_ALONE (only the edges), TINT (one color per vertex).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "light.glsl"
#include "shared/constants.h"
#include "wire.glsl"

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
float line_coverage(float least) {
  return line_coverage(in_barycentric, constants.line_width, float(constants.front >> 24), least);
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
