// Positions of vertices during a geomorph: engine/mesh/geomorph.h, the same formula in the same
// order. Include after view.glsl and normal.glsl.
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
// look even to the eye. It is a polynomial approximation of viridis (S. van der Walt, N. Smith,
// 2015), whose lightness rises evenly.
vec3 split_order_color(GeomorphConstants time, uint vertex, vec3 base) {
  if (time.split_order_scale < 0.0) return vec3(-1.0);
  if (vertex < time.first_split_vertex) return base;
  const float doublings = log2(float(vertex + 1) / float(time.first_split_vertex + 1));
  const float t = clamp(mix(0.12, 1.0, doublings * time.split_order_scale), 0.0, 1.0);
  const vec3 c0 = vec3(0.2777273272, 0.0054073445, 0.3340998053);
  const vec3 c1 = vec3(0.1050930431, 1.4046135299, 1.3845901627);
  const vec3 c2 = vec3(-0.3308618287, 0.2148475595, 0.0950951630);
  const vec3 c3 = vec3(-4.6342304989, -5.7991009733, -19.3324409563);
  const vec3 c4 = vec3(6.2282699363, 14.1799333668, 56.6905526007);
  const vec3 c5 = vec3(4.7763849977, -13.7451453777, -65.3530326334);
  const vec3 c6 = vec3(-5.4354558559, 4.6458526122, 26.3124352496);
  const vec3 root = c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * (c5 + t * c6)))));
  return root * root;
}
