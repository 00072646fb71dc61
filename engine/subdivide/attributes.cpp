#include "engine/subdivide/attributes.h"

#include <utility>

#include "engine/core/parallel.h"

namespace mesher::subdivide {
namespace {

constexpr std::size_t kAttributeGrain = 4096;

glm::vec2 middle(const glm::vec2& a, const glm::vec2& b) {
  return 0.5F * (a + b);
}

glm::u8vec4 middle(const glm::u8vec4& a, const glm::u8vec4& b) {
  glm::u8vec4 result;
  for (int i = 0; i < 4; ++i)
    result[i] = static_cast<std::uint8_t>((a[i] + b[i] + 1) / 2);
  return result;
}

/// Returns the corners of the four children of each face, in the order of `refine`.
template <class T>
Array<T> split_corners(const Array<T>& corner, Progress* progress) {
  Array<T> child(4 * corner.size());
  const auto split = [&](std::size_t f) {
    const T a = corner[3 * f];
    const T b = corner[3 * f + 1];
    const T c = corner[3 * f + 2];
    const T ab = middle(a, b);
    const T bc = middle(b, c);
    const T ca = middle(c, a);
    T* const to = &child[12 * f];
    std::size_t i = 0;
    for (const T& value : {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca})
      to[i++] = value;
  };
  parallel_chunks(corner.size() / 3, kAttributeGrain, progress, [&](std::size_t, IndexRange faces) {
    for (std::size_t f = faces.begin; f < faces.end; ++f)
      split(f);
  });
  return child;
}

Array<std::uint32_t> split_groups(const Array<std::uint32_t>& group, Progress* progress) {
  Array<std::uint32_t> child(4 * group.size());
  parallel_chunks(child.size(), kAttributeGrain, progress, [&](std::size_t, IndexRange faces) {
    for (std::size_t f = faces.begin; f < faces.end; ++f)
      child[f] = group[f / 4];
  });
  return child;
}

}  // namespace

Attributes subdivide_attributes(const Attributes& attributes, std::uint32_t levels,
                                Progress* progress) {
  if (levels == 0) return attributes;
  Attributes result;
  result.group_names = attributes.group_names;
  std::vector<double> weights{1.0};
  while (weights.size() < levels)
    weights.push_back(4.0 * weights.back());
  Stages stages(progress, weights);
  for (std::uint32_t i = 0; i < levels; ++i) {
    stages.next();
    const Attributes& coarse = i == 0 ? attributes : result;
    Stages kinds(progress, {1.0, 1.0, 1.0});
    kinds.next();
    result.texcoord = split_corners(coarse.texcoord, progress);
    kinds.next();
    result.color = split_corners(coarse.color, progress);
    kinds.next();
    result.group = split_groups(coarse.group, progress);
  }
  return result;
}

std::size_t subdivided_attribute_bytes(const Attributes& attributes, std::uint32_t levels) {
  if (levels == 0) return 0;
  const std::size_t bytes = attributes.texcoord.size() * sizeof(glm::vec2) +
                            attributes.color.size() * sizeof(glm::u8vec4) +
                            attributes.group.size() * sizeof(std::uint32_t);
  const std::size_t last = bytes << (2 * levels);
  return last + last / 4;
}

}  // namespace mesher::subdivide
