// The cheapest possible vertex shader: the reference of the frame-cost benchmark.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

layout(push_constant) uniform Constants { SurfaceConstants constants; };
layout(location = 0) in vec3 in_position;

void main() { gl_Position = to_clip(constants.view, to_view(constants.view, in_position)); }
