// Transforms vertices: see ViewTransform in engine/render/camera.h.
#include "shared/constants.h"

layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Floats {
  float at[];
};
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Uints {
  uint at[];
};

vec3 to_view(ViewConstants view, vec3 position) {
  const vec4 local = vec4(position - view.origin, 1.0);
  return vec3(dot(view.row_x, local), dot(view.row_y, local), dot(view.row_z, local));
}

vec4 to_clip(ViewConstants view, vec3 p) {
  return vec4(view.projection.x * p.x, view.projection.y * p.y,
              view.projection.z * p.z + view.projection.w, view.perspective != 0.0 ? -p.z : 1.0);
}

// Enlarges the section of the view that the viewport shows, so that it fills the clip volume: see
// Section in engine/render/section.h. Section 0 is the whole view and keeps every bit.
vec4 to_section(vec4 clip, int section) {
  const vec2 factor =
      vec2(1 << bitfieldExtract(section, 0, 4), 1 << bitfieldExtract(section, 4, 4));
  const vec2 center = vec2(bitfieldExtract(section, 8, 8), bitfieldExtract(section, 16, 8));
  return vec4(factor * clip.xy - center * clip.w, clip.zw);
}

vec3 fetch_position(Address positions, uint vertex) {
  Floats floats = Floats(positions);
  return vec3(floats.at[3 * vertex], floats.at[3 * vertex + 1], floats.at[3 * vertex + 2]);
}

uint next_halfedge(uint h) { return h % 3 == 2 ? h - 2 : h + 1; }
