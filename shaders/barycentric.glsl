// Barycentric coordinates for edges that are drawn by their faces. Include after view.glsl.

// Returns 1 at the corner and 0 along the opposite edge. If that edge is not ordinary, returns 1
// everywhere, because the line pass draws it.
vec3 barycentric(Address edge_classes, uint h) {
  const uint corner = h % 3;
  const uint first = h - corner;
  const uint shift = 2 * (first & 15);
  uint classes = Uints(edge_classes).at[first >> 4] >> shift;
  if (shift > 26) classes |= Uints(edge_classes).at[(first + 2) >> 4] << (32 - shift);
  vec3 b = vec3(0.0);
  b[corner] = 1.0;
  if ((classes & 3) != 0) b.z = 1.0;
  if ((classes & 12) != 0) b.x = 1.0;
  if ((classes & 48) != 0) b.y = 1.0;
  return b;
}
