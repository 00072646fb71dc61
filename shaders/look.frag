// Pixels of a surface that is drawn with materials. Variants: MATERIAL (lit), BASE_COLOR (not lit),
// NORMALS, CHECKER (of texture coordinates); each also with WIRE (ordinary edges on the surface).
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_GOOGLE_include_directive : require
#include "light.glsl"
#include "shared/look.h"
#include "wire.glsl"
#ifdef MATERIAL
#include "studio.glsl"
#include "reflectance.glsl"
#endif

layout(push_constant) uniform Constants { LookConstants constants; };

layout(set = 0, binding = 1) uniform Materials { MaterialBlock material; };
layout(set = 0, binding = 0) uniform sampler2D textures[kTextureCount];

layout(location = 0) in vec3 in_view;
layout(location = 1) in vec3 in_normal;
#ifdef WIRE
layout(location = 2) in vec3 in_barycentric;
#endif
layout(location = 3) in vec4 in_texcoord;
layout(location = 4) in vec4 in_color;
layout(location = 5) in vec4 in_tangent;

layout(location = 0) out vec4 out_color;

// Window y runs down, so with this order of factors the normal faces the viewer for either winding.
vec3 face_normal() { return normalize(cross(dFdy(in_view), dFdx(in_view))); }

// Returns the normal of the surface on its front side. It may point away from the viewer on the
// back, and near outlines.
vec3 front_normal() {
  const vec3 face = gl_FrontFacing ? face_normal() : -face_normal();
  return dot(in_normal, in_normal) > 1e-6 ? normalize(in_normal) : face;
}

#if defined(MATERIAL) || defined(BASE_COLOR)
bool has_texture(TextureUse use) { return use.slot < 2; }

vec2 texcoord(TextureUse use) {
  const vec2 uv = use.slot == 0 ? in_texcoord.xy : in_texcoord.zw;
  return use.matrix.xy * uv.x + use.matrix.zw * uv.y + use.offset;
}

vec4 base_color() {
  vec4 color = material.base_color * in_color;
  const TextureUse use = material.textures[kBaseColorTexture];
  if (has_texture(use)) color *= texture(textures[kBaseColorTexture], texcoord(use));
  return color;
}

// Returns the opacity of a pixel, or a negative number if the material's mask drops it. It is
// dropped at the end, because its neighbors take differences to it.
float opacity(float alpha) {
  if ((material.flags & kMasksAlpha) != 0 && alpha < material.alpha_cutoff) return -1.0;
  return (material.flags & kBlendsAlpha) != 0 ? clamp(alpha, 0.0, 1.0) : 1.0;
}
#endif

#ifdef MATERIAL
// Returns the directions in which the texture coordinates grow, u right and v up, as unit vectors.
// Without tangents they follow from differences between pixels (C. Schueler, "Normal mapping
// without precomputed tangents", ShaderX5, 2006).
mat2x3 tangents(vec3 n, vec2 uv) {
  if (in_tangent.w != 0.0) {
    const vec3 t = normalize(in_tangent.xyz);
    return mat2x3(t, cross(n, t) * sign(in_tangent.w));
  }
  const vec3 across_x = cross(dFdy(in_view), n);
  const vec3 across_y = cross(n, dFdx(in_view));
  const vec2 dx = dFdx(uv);
  const vec2 dy = dFdy(uv);
  const float side = sign(dot(dFdx(in_view), across_x));
  const vec3 t = side * (across_x * dx.x + across_y * dy.x);
  const vec3 b = side * (across_x * dx.y + across_y * dy.y);
  const float scale = inversesqrt(max(max(dot(t, t), dot(b, b)), 1e-30));
  return mat2x3(t * scale, -b * scale);  // v counts down
}

vec3 mapped_normal() {
  vec3 n = front_normal();
  const TextureUse use = material.textures[kNormalTexture];
  if (has_texture(use)) {
    const vec2 uv = texcoord(use);
    vec3 map = 2.0 * texture(textures[kNormalTexture], uv).xyz - 1.0;
    map.xy *= use.strength;
    n = normalize(tangents(n, uv) * map.xy + n * map.z);
  }
  return gl_FrontFacing ? n : -n;
}

vec3 lit(vec3 base) {
  Surfel s;
  s.base = base;
  s.metallic = material.metallic;
  s.roughness = material.roughness;
  const TextureUse shape = material.textures[kMetallicRoughnessTexture];
  if (has_texture(shape)) {
    const vec4 value = texture(textures[kMetallicRoughnessTexture], texcoord(shape));
    s.metallic *= value.b;
    s.roughness *= value.g;
  }
  const TextureUse shadow = material.textures[kOcclusionTexture];
  s.occlusion = 1.0;
  if (has_texture(shadow)) {
    const float value = texture(textures[kOcclusionTexture], texcoord(shadow)).r;
    s.occlusion += shadow.strength * (value - 1.0);
  }
  s.n = mapped_normal();
  s.v = constants.view.perspective != 0.0 ? normalize(-in_view) : vec3(0.0, 0.0, 1.0);
  vec3 emission = material.emission;
  const TextureUse glow = material.textures[kEmissionTexture];
  if (has_texture(glow)) emission *= texture(textures[kEmissionTexture], texcoord(glow)).rgb;
  return tone_mapped(reflected_light(s) + emission);
}

vec4 look() {
  const vec4 base = base_color();
  const float alpha = opacity(base.a);
  const bool is_unlit = (material.flags & kIsUnlit) != 0;
  return vec4(is_unlit ? base.rgb : lit(base.rgb), alpha);
}
#endif

#ifdef BASE_COLOR
vec4 look() {
  const vec4 base = base_color();
  return vec4(base.rgb, opacity(base.a));
}
#endif

// Returns the light of a color that is stored as sRGB (IEC 61966-2-1).
vec3 from_srgb(vec3 c) {
  return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}

#ifdef NORMALS
// The bytes of the picture are those of a normal map in the model's own space.
vec4 look() {
  const vec3 n = gl_FrontFacing ? front_normal() : -front_normal();
  const vec3 in_model = n.x * constants.view.row_x.xyz + n.y * constants.view.row_y.xyz +
                        n.z * constants.view.row_z.xyz;
  return vec4(from_srgb(0.5 + 0.5 * normalize(in_model)), 1.0);
}
#endif

#ifdef CHECKER
// Eight squares per unit. Red grows with u and green with v, so that mirrored and turned parts show.
vec4 look() {
  const vec2 uv = in_texcoord.xy;
  const vec2 place = fract(uv);
  const vec2 cell = 8.0 * uv;
  // Squares narrower than two pixels become gray, rather than a pattern that is not there.
  const vec2 width = max(fwidth(cell), 1e-6);
  const vec2 wave = abs(fract(0.5 * cell + 0.25) - 0.5) * 2.0 - 0.5;
  const vec2 square = clamp(wave / width, -0.5, 0.5) * clamp(2.0 - width, 0.0, 1.0);
  const float dark = 0.5 + 2.0 * square.x * square.y;
  const vec3 tint = vec3(0.25 + 0.7 * place.x, 0.25 + 0.7 * place.y, 0.6);
  const float facing = abs(face_normal().z);
  return vec4(from_srgb(mix(0.55, 1.0, dark) * tint) * (0.35 + 0.65 * facing), 1.0);
}
#endif

void main() {
  vec4 color = look();
  const bool is_dropped = color.a < 0.0;
#ifdef WIRE
  const float coverage = line_coverage(in_barycentric, constants.line_width,
                                       float(constants.front >> 24), 0.08) *
                         unpackUnorm4x8(constants.line).a;
  color.rgb = mix(color.rgb, decode_color(constants.line), coverage);
  color.a = max(color.a, coverage);
#endif
  if (is_dropped) discard;
  out_color = vec4(color.rgb * color.a, color.a);
}
