// Poses of vertices: each follows some matrices of a palette. Include after view.glsl.

struct PoseRows {
  vec4 x;
  vec4 y;
  vec4 z;
};

layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer PosePalette {
  PoseRows at[];
};
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer Pose {
  PoseConstants at;
};

// Returns the mean of the matrices that a vertex follows, by their weights.
PoseRows rows_of(PoseConstants pose, uint vertex) {
  PoseRows mean = PoseRows(vec4(0.0), vec4(0.0), vec4(0.0));
  for (uint i = 0; i < pose.per_vertex; ++i) {
    const uint word = 2 * (vertex * pose.per_vertex + i);
    const float weight = uintBitsToFloat(Uints(pose.influences).at[word + 1]);
    if (weight == 0.0) continue;
    const PoseRows rows = PosePalette(pose.palette).at[Uints(pose.influences).at[word]];
    mean.x += weight * rows.x;
    mean.y += weight * rows.y;
    mean.z += weight * rows.z;
  }
  return mean;
}

vec3 posed_position(PoseRows rows, vec3 p) {
  precise vec3 posed =
      vec3(dot(rows.x, vec4(p, 1.0)), dot(rows.y, vec4(p, 1.0)), dot(rows.z, vec4(p, 1.0)));
  return posed;
}

vec3 posed_direction(PoseRows rows, vec3 v) {
  return vec3(dot(rows.x.xyz, v), dot(rows.y.xyz, v), dot(rows.z.xyz, v));
}

// The cofactors are the inverse transpose up to a factor, whose sign is that of the determinant.
vec3 posed_normal(PoseRows rows, vec3 n) {
  const vec3 yz = cross(rows.y.xyz, rows.z.xyz);
  const vec3 zx = cross(rows.z.xyz, rows.x.xyz);
  const vec3 xy = cross(rows.x.xyz, rows.y.xyz);
  const vec3 turned = vec3(dot(yz, n), dot(zx, n), dot(xy, n)) * sign(dot(rows.x.xyz, yz));
  const float square = dot(turned, turned);
  return square > 0.0 ? turned * inversesqrt(square) : n;
}
