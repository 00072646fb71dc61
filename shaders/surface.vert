// Vertices of a surface. Variants: GOURAUD passes normals on. PULLED takes no vertex input but the
// index of a half-edge, so that corners of one vertex can differ in their barycentric coordinate,
// and (CORNER_NORMALS) in their normal. MORPH moves vertices during a geomorph and colors them.
// POSED moves them by the joints and placements of a scene.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "normal.glsl"
#ifdef PULLED
#include "barycentric.glsl"
#endif
#ifdef MORPH
#include "geomorph.glsl"
#include "light.glsl"
#endif
#ifdef POSED
#include "pose.glsl"
#endif

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
#ifdef MORPH
layout(location = 3) out vec3 out_tint;
#endif

// The depth of a vertex must have the same bits in every pass.
invariant gl_Position;

#ifdef MORPH
GeomorphConstants geomorph() { return Geomorph(constants.positions).at; }
#endif

#ifdef PULLED
uint vertex_number() { return Uints(constants.indices).at[gl_VertexIndex]; }
vec3 mesh_position(uint vertex) {
#if defined(MORPH)
  return fetch_position(geomorph().positions, vertex);
#elif defined(POSED)
  return fetch_position(Pose(constants.positions).at.positions, vertex);
#else
  return fetch_position(constants.positions, vertex);
#endif
}
#else
uint vertex_number() { return gl_VertexIndex; }
vec3 mesh_position(uint vertex) { return in_position; }
#endif

#ifdef GOURAUD
vec3 mesh_normal(uint vertex) {
#if defined(CORNER_NORMALS)
  return decode_normal(unpackSnorm2x16(Uints(constants.normals).at[gl_VertexIndex]));
#elif defined(PULLED)
  return decode_normal(unpackSnorm2x16(Uints(constants.normals).at[vertex]));
#else
  return decode_normal(in_normal);
#endif
}
#endif

void main() {
  const uint vertex = vertex_number();
  vec3 position = mesh_position(vertex);
#ifdef GOURAUD
  vec3 n = mesh_normal(vertex);
#endif
#ifdef MORPH
#if defined(GOURAUD) && !defined(CORNER_NORMALS)
  morph(geomorph(), vertex, position, n);
#else
  morph(geomorph(), vertex, position);  // corner normals stay unchanged
#endif
  out_tint = split_order_color(geomorph(), vertex, decode_color(constants.front));
#endif
#ifdef POSED
  const PoseRows rows = rows_of(Pose(constants.positions).at, vertex);
  position = posed_position(rows, position);
#ifdef GOURAUD
  n = posed_normal(rows, n);
#endif
#endif
#ifdef PULLED
  out_barycentric = barycentric(constants.classes, gl_VertexIndex);
#endif
  const vec3 in_view = to_view(constants.view, position);
#ifdef GOURAUD
  out_normal = vec3(dot(constants.view.row_x.xyz, n), dot(constants.view.row_y.xyz, n),
                    dot(constants.view.row_z.xyz, n));
#else
  out_view = in_view;
#endif
  gl_Position = to_section(to_clip(constants.view, in_view), gl_InstanceIndex);
}
