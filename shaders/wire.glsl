// Ordinary edges, drawn by the pixels of their faces.

// Returns how much of the pixel ordinary edges cover. Lines closer together than a few pixels of
// the window fade to `least`; at full strength they would only look dark.
float line_coverage(vec3 barycentric, float line_width, float pixel_ratio, float least) {
  const vec3 dx = dFdx(barycentric);
  const vec3 dy = dFdy(barycentric);
  const vec3 altitude = inversesqrt(max(dx * dx + dy * dy, 1e-12));  // pixels from edge to corner
  const vec3 away = abs(barycentric) * altitude;
  const vec3 covered = clamp(0.5 * line_width + 0.5 - away, 0.0, 1.0);
  // Side of a square with twice the triangle's area, computed from whichever two coordinates vary.
  const vec3 inverse_area = abs(cross(dx, dy));
  const float spacing =
      inversesqrt(max(max(inverse_area.x, max(inverse_area.y, inverse_area.z)), 1e-12)) /
      pixel_ratio;
  return max(covered.x, max(covered.y, covered.z)) * clamp((spacing - 1.0) / 7.0, least, 1.0);
}
