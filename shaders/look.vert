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

vec4 stored_color(Surface surface, uint wedge) {
  return has_layer(surface.at.color) ? fetch_value(surface.at.color, wedge, vec4(1.0)) : vec4(1.0);
}

vec4 linear_color(Surface surface, vec4 color) {
  if (!has_layer(surface.at.color) || (surface.at.flags & kLinearColors) != 0) return color;
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

#ifdef MORPH
struct Attributes {
  vec3 normal;
  vec4 tangent;
  vec4 color;
  vec4 texcoord;
};

// Returns the difference of a value in one change, from its first word on.
vec4 change_of(Surface surface, uint word, uint components) {
  Floats words = Floats(surface.at.changes);
  vec4 change = vec4(0.0);
  for (uint c = 0; c < components; ++c)
    change[c] = words.at[word + c];
  return change;
}

// Takes what a change has not added yet from the values: morphed_value in engine/mesh/geomorph.h.
void take_back(Surface surface, uint change, float rest, inout Attributes values) {
  const uint first = change * surface.at.change_stride;
  if (surface.at.normal_change != 0)
    values.normal -= rest * change_of(surface, first + surface.at.normal_change, 3).xyz;
  if (surface.at.tangent_change != 0)
    values.tangent.xyz -= rest * change_of(surface, first + surface.at.tangent_change, 3).xyz;
  if (surface.at.color_change != 0)
    values.color -= rest * change_of(surface, first + surface.at.color_change,
                                     surface.at.color.format & 7);
  const uint sets = material.sets;
  const uvec2 sets_change = uvec2(surface.at.texcoord_change[sets & 255],
                                  surface.at.texcoord_change[sets >> 8]);
  if (sets_change.x != 0)
    values.texcoord.xy -= rest * change_of(surface, first + sets_change.x, 2).xy;
  if (sets_change.y != 0)
    values.texcoord.zw -= rest * change_of(surface, first + sets_change.y, 2).xy;
}

// Morphs the position of a vertex and the values of a wedge. There may be only one loop: see
// geomorph.glsl.
void morph(Surface surface, uint vertex, uint wedge, inout vec3 position,
           inout Attributes values) {
  const GeomorphConstants time = Geomorph(constants.geomorph).at;
  const uint stride = surface.at.change_stride;
  const bool moves_values = stride != 0 && time.first_head != kNoHead;
  uint head = head_of(time, vertex);
  uint change = moves_values ? Uints(surface.at.change_heads).at[wedge] : kNoHead;
  uint split = change == kNoHead ? kNoHead : Uints(surface.at.changes).at[change * stride];
  precise vec3 p = position;
  const vec3 normal = values.normal;
  while (is_growing(time, head) || (change != kNoHead && is_growing(time, 2 * split))) {
    if (is_growing(time, head)) {
      p -= share_to_come(time, head);
      head = previous(time, head);
    }
    if (change != kNoHead && is_growing(time, 2 * split)) {
      take_back(surface, change, remaining(time, split), values);
      change = Uints(surface.at.changes).at[change * stride + 1];
      split = change == kNoHead ? kNoHead : Uints(surface.at.changes).at[change * stride];
    }
  }
  position = p;
  const float square = dot(values.normal, values.normal);
  if (square > 0.0 && values.normal != normal) values.normal *= inversesqrt(square);
}
#endif

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
  vec4 color = stored_color(surface, wedge);
  out_texcoord.xy = fetch_value(surface.at.texcoord[sets & 255], wedge, vec4(0.0)).xy;
  out_texcoord.zw = fetch_value(surface.at.texcoord[sets >> 8], wedge, vec4(0.0)).xy;
#ifdef MORPH
  Attributes attributes = Attributes(normal, tangent, color, out_texcoord);
  morph(surface, vertex, wedge, position, attributes);
  normal = attributes.normal;
  tangent = attributes.tangent;
  color = attributes.color;
  out_texcoord = attributes.texcoord;
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
  out_color = linear_color(surface, color);
  out_tangent = vec4(turned(tangent.xyz), tangent.w);
#ifdef WIRE
  out_barycentric = barycentric(surface.at.classes, h);
#endif
  gl_Position = to_section(to_clip(constants.view, out_view), gl_InstanceIndex);
}
