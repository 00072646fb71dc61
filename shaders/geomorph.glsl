// Positions of vertices during a geomorph: engine/mesh/geomorph.h, the same formula in the same
// order. Include after view.glsl and normal.glsl.
#include "shared/split_order.h"

layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer Geomorph {
  GeomorphConstants at;
};

const uint kNoHead = 0xFFFFFFFFu;
// The words of a SplitMorph.
const uint kSplitWords = 10;
const uint kParentDelta = 0;
const uint kPrevious = 3;
const uint kChildDelta = 4;
const uint kCoarseNormal = 7;
const uint kParentNormal = 8;
const uint kChildNormal = 9;

// Returns the fraction of a split still to come, 1 to 0.
float remaining(GeomorphConstants time, uint split) {
  precise float grown =
      time.fixed_share + time.rate * (float(time.whole - int(split)) + time.fraction);
  return 1.0 - clamp(grown, 0.0, 1.0);
}

// Returns whether a head grows. kNoHead + 1 is 0, so kNoHead never does.
bool is_growing(GeomorphConstants time, uint head) { return head + 1 > time.first_head; }

// Returns the head of the newest split that moves a vertex. All others are linked from it.
uint head_of(GeomorphConstants time, uint vertex) {
  // If nothing grows, there may be no heads.
  return time.first_head == kNoHead ? kNoHead : Uints(time.heads).at[vertex];
}

vec3 fetch_delta(GeomorphConstants time, uint word) {
  Floats words = Floats(time.splits);
  return vec3(words.at[word], words.at[word + 1], words.at[word + 2]);
}

vec3 fetch_normal(GeomorphConstants time, uint word) {
  return decode_normal(unpackSnorm2x16(Uints(time.splits).at[word]));
}

vec3 share_to_come(GeomorphConstants time, uint head) {
  const uint delta = (head & 1) != 0 ? kChildDelta : kParentDelta;
  return remaining(time, head >> 1) * fetch_delta(time, kSplitWords * (head >> 1) + delta);
}

uint previous(GeomorphConstants time, uint head) {
  return Uints(time.splits).at[kSplitWords * (head >> 1) + kPrevious];
}

// A shader may contain only one of the loops below. With two, llvmpipe of Mesa 22.3 moves some
// vertices that must not move.
void morph(GeomorphConstants time, uint vertex, inout vec3 position) {
  precise vec3 p = position;
  for (uint head = head_of(time, vertex); is_growing(time, head);) {
    p -= share_to_come(time, head);
    head = previous(time, head);
  }
  position = p;
}

// Morphs a position and a normal.
void morph(GeomorphConstants time, uint vertex, inout vec3 position, inout vec3 normal) {
  precise vec3 p = position;
  precise vec3 n = normal;
  for (uint head = head_of(time, vertex); is_growing(time, head);) {
    p -= share_to_come(time, head);
    const uint split = kSplitWords * (head >> 1);
    const vec3 after = fetch_normal(time, split + ((head & 1) != 0 ? kChildNormal : kParentNormal));
    n -= remaining(time, head >> 1) * (after - fetch_normal(time, split + kCoarseNormal));
    head = previous(time, head);
  }
  position = p;
  const float square = dot(n, n);
  if (square > 0.0 && n != normal) normal = n * inversesqrt(square);
}

// Morphs two positions.
void morph(GeomorphConstants time, uvec2 vertices, inout vec3 a, inout vec3 b) {
  precise vec3 p = a;
  precise vec3 q = b;
  uint p_head = head_of(time, vertices.x);
  uint q_head = head_of(time, vertices.y);
  while (is_growing(time, p_head) || is_growing(time, q_head)) {
    if (is_growing(time, p_head)) {
      p -= share_to_come(time, p_head);
      p_head = previous(time, p_head);
    }
    if (is_growing(time, q_head)) {
      q -= share_to_come(time, q_head);
      q_head = previous(time, q_head);
    }
  }
  a = p;
  b = q;
}

// Returns the linear color of the surface at a vertex, or `base` if no split created the vertex.
// Negative: the surface has one color.
//
// The color advances by the same step whenever the number of vertices has doubled, in steps that
// look even to the eye.
vec3 split_order_color(GeomorphConstants time, uint vertex, vec3 base) {
  if (time.split_order_scale < 0.0) return vec3(-1.0);
  if (vertex < time.first_split_vertex) return base;
  const float doublings = log2(float(vertex + 1) / float(time.first_split_vertex + 1));
  return split_order_ramp(clamp(doublings * time.split_order_scale, 0.0, 1.0));
}
