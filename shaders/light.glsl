// The studio: everything in view space, so that the light comes with the camera and a shape reads
// the same from every side. `n` is a unit normal that faces the viewer.
vec3 decode_color(uint packed) {
  const vec3 root = unpackUnorm4x8(packed).rgb;
  return root * root;
}

vec3 shade(vec3 n, vec3 base) {
  const vec3 key_direction = vec3(-0.40, 0.58, 0.71);
  const vec3 fill_direction = vec3(0.83, -0.21, 0.52);
  // Sky above, floor below: no normal is left in plain black.
  const vec3 ambient = mix(vec3(0.16, 0.15, 0.15), vec3(0.36, 0.37, 0.40), 0.5 + 0.5 * n.y);
  const float key = max(dot(n, key_direction), 0.0);
  const float fill = max(dot(n, fill_direction), 0.0);
  const vec3 light = ambient + key * vec3(0.88, 0.86, 0.82) + fill * vec3(0.10, 0.11, 0.14);
  // A wide, weak gloss: shows curvature, hides nothing.
  const vec3 halfway = normalize(key_direction + vec3(0.0, 0.0, 1.0));
  const float gloss = pow(max(dot(n, halfway), 0.0), 24.0);
  return base * light + vec3(0.06 * gloss);
}
