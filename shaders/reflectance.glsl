// The metallic-roughness material of glTF 2.0, appendix B, under the light of a whole studio.
// Include after studio.glsl.
struct Surfel {
  vec3 base;
  float metallic;
  float roughness;
  float occlusion;  // 1: the surface sees everything
  vec3 n;           // unit vectors toward the viewer
  vec3 v;
};

// Returns the factors of the reflectance at normal incidence and of white in what a surface
// reflects of an even light: a fit of the integral of the microfacet BRDF (B. Karis, "Physically
// based shading on mobile", 2014).
vec2 reflected_shares(float roughness, float n_dot_v) {
  const vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  const float a = min(r.x * r.x, exp2(-9.28 * n_dot_v)) * r.x + r.y;
  return vec2(-1.04, 1.04) * a + r.zw;
}

vec3 reflected_light(Surfel s) {
  const float n_dot_v = clamp(dot(s.n, s.v), 0.0, 1.0);
  const vec2 share = reflected_shares(s.roughness, n_dot_v);
  const float kDielectric = 0.04;
  const vec3 specular_color = mix(vec3(kDielectric), s.base, s.metallic) * share.x + share.y;
  // Light that the surface reflects does not enter it.
  const vec3 diffuse_color =
      s.base * (1.0 - s.metallic) * (1.0 - (kDielectric * share.x + share.y));
  // S. Lagarde, C. de Rousiers, "Moving Frostbite to physically based rendering", 2014.
  const float seen = clamp(pow(n_dot_v + s.occlusion, exp2(-16.0 * s.roughness - 1.0)) - 1.0 +
                               s.occlusion,
                           0.0, 1.0);
  return s.occlusion * diffuse_color * diffuse_light(s.n) +
         seen * specular_color * specular_light(reflect(-s.v, s.n), s.roughness, n_dot_v);
}

// Maps light without a limit to 0..1. Base colors keep their hue and, under even light, nearly
// their value (Khronos PBR Neutral tone mapper, 2024).
vec3 tone_mapped(vec3 light) {
  const float kDesaturation = 0.15;
  const float kStart = 0.8 - 0.04;
  const float low = min(light.r, min(light.g, light.b));
  light -= low < 0.08 ? low - 6.25 * low * low : 0.04;
  const float peak = max(light.r, max(light.g, light.b));
  if (peak < kStart) return light;
  const float room_above = 1.0 - kStart;
  const float mapped = 1.0 - room_above * room_above / (peak + room_above - kStart);
  return mix(vec3(mapped), light * mapped / peak, 1.0 / (kDesaturation * (peak - mapped) + 1.0));
}
