// Edges as quads in the window: six vertices per edge, wide enough for anti-aliased borders and
// round ends. Round ends make joints look like one line. Variant ORDINARY: the ordinary edges of
// the mesh, selected from all its half-edges. Variant MORPH: their ends move during a geomorph; POSED: they
// follow the joints and placements of a scene.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#ifdef MORPH
#include "normal.glsl"
#include "geomorph.glsl"
#endif
#ifdef POSED
#include "pose.glsl"
#endif

layout(push_constant) uniform Constants { LineConstants constants; };

layout(location = 0) out vec2 out_line_position;  // along and across, pixels from the first end
layout(location = 1) out float out_length;  // pixels
layout(location = 2) out float out_strength;
layout(location = 3) flat out float out_half_width;  // pixels

// Clips the segment to the part in front of the near plane. Returns false if none remains.
bool clip_to_near(inout vec3 a, inout vec3 b) {
  if (constants.view.perspective == 0.0) return true;
  const float near = constants.view.projection.w / (1.0 + constants.view.projection.z);
  const float a_depth = -a.z - near;
  const float b_depth = -b.z - near;
  if (a_depth < 0.0 && b_depth < 0.0) return false;
  if (a_depth < 0.0) {
    a = mix(b, a, b_depth / (b_depth - a_depth));
  } else if (b_depth < 0.0) {
    b = mix(a, b, a_depth / (a_depth - b_depth));
  }
  return true;
}

vec2 picture_size() {
  return vec2(constants.picture & 0xFFFFu, constants.picture >> 16);
}

// Returns the window position in pixels from the center, and the depth. The position is lifted
// toward the viewer by more than the line's half width. So across its width the line wins against
// its own surface, up to a slope of 1.5. (A depth bias on the surface instead would let back faces
// show through at silhouettes, where slopes are unbounded.)
vec3 to_window(vec3 p) {
  const float w = constants.view.perspective != 0.0 ? -p.z : 1.0;
  const vec2 picture = picture_size();
  const float pixel = 2.0 * w / (abs(constants.view.projection.y) * picture.y);
  const vec4 flat_clip = to_clip(constants.view, p);
  const float lift = 1.5 * (constants.half_width + 0.5) * pixel;
  const vec4 clip = to_clip(constants.view, vec3(p.xy, p.z + min(lift, 0.5 * w)));
  return vec3(0.5 * picture * flat_clip.xy / flat_clip.w, min(clip.z / clip.w, 1.0));
}

#ifdef ORDINARY
uint halfedge(uint line) { return line; }

// Only the half-edge that runs to the higher vertex draws the edge.
bool is_drawn(uint h, uint from, uint to) {
  const uint edge_class = (Uints(constants.classes).at[h >> 4] >> (2 * (h & 15))) & 3;
  return edge_class == 0 && from < to;
}
#else
uint halfedge(uint line) { return Uints(constants.lines).at[2 * line]; }
float weight(uint line) { return uintBitsToFloat(Uints(constants.lines).at[2 * line + 1]); }

bool is_drawn(uint h, uint from, uint to) { return true; }
#endif

void fetch_ends(uint first, uint second, out vec3 a, out vec3 b) {
#if defined(MORPH)
  const GeomorphConstants time = Geomorph(constants.positions).at;
  a = fetch_position(time.positions, first);
  b = fetch_position(time.positions, second);
  morph(time, uvec2(first, second), a, b);
#elif defined(POSED)
  const PoseConstants pose = Pose(constants.positions).at;
  a = posed_position(rows_of(pose, first), fetch_position(pose.positions, first));
  b = posed_position(rows_of(pose, second), fetch_position(pose.positions, second));
#else
  a = fetch_position(constants.positions, first);
  b = fetch_position(constants.positions, second);
#endif
}

// Six equal positions: nothing is drawn.
void draw_nothing() {
  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
  out_line_position = vec2(0.0);
  out_length = 0.0;
  out_strength = 0.0;
  out_half_width = 0.0;
}

void main() {
  const uint h = halfedge(gl_VertexIndex / 6);
  const uint first = Uints(constants.indices).at[h];
  const uint second = Uints(constants.indices).at[next_halfedge(h)];
  vec3 a;
  vec3 b;
  fetch_ends(first, second, a, b);
  a = to_view(constants.view, a);
  b = to_view(constants.view, b);
  if (!is_drawn(h, first, second) || !clip_to_near(a, b)) {
    draw_nothing();
    return;
  }
  const vec3 from = to_window(a);
  const vec3 to = to_window(b);
  const vec2 between = to.xy - from.xy;
  out_length = length(between);
  const vec2 along = out_length > 1e-6 ? between / out_length : vec2(1.0, 0.0);
  const vec2 across = vec2(-along.y, along.x);

#ifdef ORDINARY
  // As in surface.frag. But there a pixel belongs to one face; here edges shorter than two pixels
  // pile up, and more so the shorter they are.
  const float window_length = out_length / constants.pixel_ratio;
  out_strength = clamp((window_length - 1.0) / 7.0, 0.08, 1.0) *
                 min(0.25 * window_length * window_length, 1.0);
  out_half_width = constants.half_width;
#else
  // A line of low weight is still wider than an ordinary edge and differs in color, so that every
  // tagged edge is visible.
  const float full = weight(gl_VertexIndex / 6);
  out_strength = mix(0.45, 1.0, full);
  out_half_width = constants.half_width * mix(0.4, 1.0, full);
#endif

  const uint corner = gl_VertexIndex % 6;
  const bool is_end = corner == 1 || corner == 2 || corner == 4;
  const bool is_left = corner >= 2 && corner != 3;
  const float reach = constants.half_width + 1.0;
  out_line_position = vec2(is_end ? out_length + reach : -reach, is_left ? reach : -reach);
  const vec2 position = from.xy + along * out_line_position.x + across * out_line_position.y;
  const vec4 clip = vec4(2.0 * position / picture_size(), is_end ? to.z : from.z, 1.0);
  gl_Position = to_section(clip, gl_InstanceIndex);
}
