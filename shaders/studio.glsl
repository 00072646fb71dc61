// The light of a photographer's studio, in view space like that of light.glsl: a bright ceiling
// over a dim floor, and softboxes. Nothing is stored or downloaded: a softbox is a spherical
// Gaussian, exp(sharpness * (dot(direction, axis) - 1)) times its radiance, and those multiply and
// integrate in closed form (J. Wang et al., "All-frequency rendering of dynamic, spatially-varying
// reflectance", 2009).
const float kPi = 3.14159265;

struct Softbox {
  vec3 axis;
  float sharpness;
  vec3 radiance;
};

const Softbox kKey =  // as in light.glsl
    Softbox(vec3(-0.52, 0.57, 0.636), 14.0, vec3(4.70, 4.62, 4.45));
const Softbox kFill = Softbox(vec3(0.85, -0.10, 0.517), 5.0, vec3(0.62, 0.66, 0.72));
const Softbox kRim =  // behind the model
    Softbox(vec3(0.42, 0.66, -0.624), 24.0, vec3(7.50, 7.50, 7.70));
const Softbox kStrip =  // at the side
    Softbox(vec3(-0.93, 0.10, -0.35), 18.0, vec3(2.60, 2.70, 2.90));

// Returns the light of ceiling and floor, blurred by `roughness`. At 1 it is that of diffuse
// surfaces.
vec3 room(vec3 direction, float roughness) {
  const float width = mix(0.15, 1.0, roughness);
  const float up = smoothstep(-width, width, direction.y);
  return mix(vec3(0.16, 0.155, 0.15), vec3(0.42, 0.43, 0.45), up);
}

// Returns the integral over the sphere of a softbox times exp(sharpness * (dot(d, axis) - 1)).
vec3 integral(Softbox box, vec3 axis, float sharpness) {
  const float both = length(box.sharpness * box.axis + sharpness * axis);
  return box.radiance * exp(both - box.sharpness - sharpness) * 2.0 * kPi *
         (1.0 - exp(-2.0 * both)) / both;
}

// Returns the same of all softboxes.
vec3 integral_of_all(vec3 axis, float sharpness) {
  return integral(kKey, axis, sharpness) + integral(kFill, axis, sharpness) +
         integral(kRim, axis, sharpness) + integral(kStrip, axis, sharpness);
}

// Returns the light that a white diffuse surface reflects. The cosine is nearly the Gaussian
// 1.17 exp(2.133 (cosine - 1)) (Wang et al.).
vec3 diffuse_light(vec3 n) {
  return room(n, 1.0) + 1.17 / kPi * integral_of_all(n, 2.133);
}

// Returns the light around `direction`, weighted by the lobe of the microfacets: GGX is nearly a
// Gaussian of sharpness 2 / alpha^2 around the halfway vector, which is four times as wide, per
// cosine of the view, around the reflection (Wang et al.).
vec3 specular_light(vec3 direction, float roughness, float n_dot_v) {
  const float alpha = max(roughness * roughness, 0.02);
  const float sharpness = 0.5 / (alpha * alpha * max(n_dot_v, 0.1));
  const float norm = sharpness / (2.0 * kPi * (1.0 - exp(-2.0 * sharpness)));
  return room(direction, roughness) + norm * integral_of_all(direction, sharpness);
}
