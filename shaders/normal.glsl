// Inverse of encode_normal in engine/mesh/packed_normal.h (Q. Meyer et al., "On floating-point
// normal vectors", 2010).
vec3 decode_normal(vec2 e) {
  vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
  const float fold = max(-n.z, 0.0);
  n.x += n.x >= 0.0 ? -fold : fold;
  n.y += n.y >= 0.0 ? -fold : fold;
  return normalize(n);
}
