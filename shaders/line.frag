// Coverage of a line with round ends: its distance field, with an edge one pixel soft.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "light.glsl"
#include "shared/constants.h"

layout(push_constant) uniform Constants { LineConstants constants; };

layout(location = 0) in vec2 in_line_position;
layout(location = 1) in float in_length;
layout(location = 2) in float in_strength;
layout(location = 3) flat in float in_half_width;

layout(location = 0) out vec4 out_color;

void main() {
  const float beyond = max(max(-in_line_position.x, in_line_position.x - in_length), 0.0);
  const float away = length(vec2(beyond, in_line_position.y));
  const float coverage = clamp(in_half_width + 0.5 - away, 0.0, 1.0);
  const float alpha = coverage * in_strength * unpackUnorm4x8(constants.color).a;
  out_color = vec4(alpha * decode_color(constants.color), alpha);
}
