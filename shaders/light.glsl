// Studio lighting. Everything is in view space, so the lights move with the camera and a shape
// looks the same from every side. `n` is a unit normal that faces the viewer.
vec3 decode_color(uint packed) {
  const vec3 root = unpackUnorm4x8(packed).rgb;
  return root * root;
}

vec3 shade(vec3 n, vec3 base) {
  const vec3 key_direction = vec3(-0.52, 0.57, 0.636);
  const vec3 fill_direction = vec3(0.85, -0.10, 0.517);
  // Sky above, floor below: no normal is plain black.
  const vec3 ambient = mix(vec3(0.10, 0.10, 0.11), vec3(0.30, 0.31, 0.33), 0.5 + 0.5 * n.y);
  const float key = max(dot(n, key_direction), 0.0);
  const float fill = max(dot(n, fill_direction), 0.0);
  const vec3 light = ambient + key * vec3(0.98, 0.96, 0.93) + fill * vec3(0.13, 0.14, 0.16);
  // A wide, weak highlight: it shows curvature and hides nothing.
  const vec3 halfway = vec3(-0.2875, 0.3151, 0.9045);  // between the key light and the viewer
  const float facing = max(dot(n, halfway), 0.0);
  const float facing_2 = facing * facing;
  const float facing_8 = facing_2 * facing_2 * facing_2 * facing_2;
  return base * light + vec3(0.05 * facing_8 * facing_8 * facing_8);
}
