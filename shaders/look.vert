// Vertices of a surface that is drawn with materials. They take no vertex input but the number of a
// corner: position and attributes are pulled by its vertex and its wedge. Variant WIRE passes
// barycentric coordinates on; MORPH moves vertices during a geomorph, and the others by a pose.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "normal.glsl"
#include "attributes.glsl"
#include "barycentric.glsl"
#ifdef MORPH
#include "geomorph.glsl"
#include "light.glsl"
#else
#include "pose.glsl"
#endif

layout(push_constant) uniform Constants { LookConstants constants; };

layout(set = 0, binding = 1) uniform Materials { MaterialBlock material; };

layout(location = 0) out vec3 out_view;
layout(location = 1) out vec3 out_normal;  // in view space; 0: that of the face
#ifdef WIRE
layout(location = 2) out vec3 out_barycentric;
#endif
layout(location = 3) out vec4 out_texcoord;  // two sets
layout(location = 4) out vec4 out_color;     // linear
layout(location = 5) out vec4 out_tangent;   // in view space, with handedness; 0: there is none

// The depth of a vertex must have the same bits in every pass.
invariant gl_Position;

uint halfedge() {
  const uint face = gl_VertexIndex / 3;
  const bool is_listed = constants.faces != uvec2(0);
  return 3 * (is_listed ? Uints(constants.faces).at[face] : face) + gl_VertexIndex % 3;
}

vec3 normal_of(Surface surface, uint h, uint vertex, uint wedge) {
  if (has_layer(surface.at.normal)) return fetch_value(surface.at.normal, wedge, vec4(0.0)).xyz;
  const bool is_corner = (surface.at.flags & kCornerNormals) != 0;
  if (!is_corner && (surface.at.flags & kVertexNormals) == 0) return vec3(0.0);
  return decode_normal(unpackSnorm2x16(Uints(surface.at.normals).at[is_corner ? h : vertex]));
}

vec4 color_of(Surface surface, uint wedge) {
  if (!has_layer(surface.at.color)) return vec4(1.0);
  const vec4 color = fetch_value(surface.at.color, wedge, vec4(1.0));
  if ((surface.at.flags & kLinearColors) != 0) return color;
  // The curve of sRGB (IEC 61966-2-1).
  const vec3 curve = pow((color.rgb + 0.055) / 1.055, vec3(2.4));
  return vec4(mix(curve, color.rgb / 12.92, lessThanEqual(color.rgb, vec3(0.04045))), color.a);
}

// Returns a direction in view space. The rows also scale the model to the camera's distance.
vec3 turned(vec3 v) {
  return vec3(dot(constants.view.row_x.xyz, v), dot(constants.view.row_y.xyz, v),
              dot(constants.view.row_z.xyz, v)) /
         length(constants.view.row_x.xyz);
}

void main() {
  Surface surface = Surface(constants.surface);
  const uint h = halfedge();
  const uint vertex = Uints(surface.at.indices).at[h];
  const bool has_seams = (surface.at.flags & kHasSeams) != 0;
  const uint wedge = has_seams ? Uints(surface.at.wedges).at[h] : vertex;
  const uint sets = material.sets;

  vec3 position = fetch_position(surface.at.positions, vertex);
  vec3 normal = normal_of(surface, h, vertex, wedge);
  vec4 tangent = fetch_value(surface.at.tangent, wedge, vec4(0.0));
#ifdef MORPH
  morph(Geomorph(constants.geomorph).at, vertex, position);  // attributes stay unchanged
#else
  if (surface.at.pose.per_vertex != 0) {
    const PoseRows rows = rows_of(surface.at.pose, vertex);
    position = posed_position(rows, position);
    normal = posed_normal(rows, normal);
    tangent.xyz = posed_direction(rows, tangent.xyz);
  }
#endif
  out_view = to_view(constants.view, position);
  out_normal = turned(normal);
  out_texcoord.xy = fetch_value(surface.at.texcoord[sets & 255], wedge, vec4(0.0)).xy;
  out_texcoord.zw = fetch_value(surface.at.texcoord[sets >> 8], wedge, vec4(0.0)).xy;
  out_color = color_of(surface, wedge);
  out_tangent = vec4(turned(tangent.xyz), tangent.w);
#ifdef WIRE
  out_barycentric = barycentric(surface.at.classes, h);
#endif
  gl_Position = to_section(to_clip(constants.view, out_view), gl_InstanceIndex);
}
