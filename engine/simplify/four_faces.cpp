#include "engine/simplify/four_faces.h"

namespace mesher::simplify {
namespace {

// A face thinner than this share of its longest side counts as that thick: the gradient over a
// sliver is noise, and its rounding would stay in the sums.
constexpr float kThinnest = 0.01F;

/// The directions by which differences of a value become its gradient over a face.
struct GradientBasis {
  Vec3<Float4> of_first;   ///< times value 1 - value 0
  Vec3<Float4> of_second;  ///< times value 2 - value 0
  Float4 area;
};

GradientBasis gradient_basis(const std::array<Vec3<Float4>, 3>& p) {
  const Vec3<Float4> first = p[1] - p[0];
  const Vec3<Float4> second = p[2] - p[0];
  const Vec3<Float4> third = p[2] - p[1];
  const Vec3<Float4> normal = cross(first, second);
  const Float4 zero = broadcast<Float4>(0.0F);
  const Float4 area2 = dot(normal, normal);
  const Float4 longest2 =
      greater_of(greater_of(dot(first, first), dot(second, second)), dot(third, third));
  const Float4 least = broadcast<Float4>(kThinnest) * longest2;
  const Float4 divisor = greater_of(area2, least * least);
  const Float4 inverse = select(divisor > zero, broadcast<Float4>(1.0F) / divisor, zero);
  return {cross(second, normal) * inverse, cross(normal, first) * inverse,
          broadcast<Float4>(0.5F) * square_root(area2)};
}

}  // namespace

void FourContributions::set(const FourFaces& faces, std::size_t size) {
  const GradientBasis basis = gradient_basis(faces.position);
  const Vec3<Float4> u = basis.of_first * basis.area;
  const Vec3<Float4> v = basis.of_second * basis.area;
  const Float4 zero = broadcast<Float4>(0.0F);
  const auto set_row = [&](std::size_t row, Float4 x, Float4 y, Float4 z, Float4 w) {
    transpose(x, y, z, w);
    Float4* const to = &rows_[4 * row];
    to[0] = x;
    to[1] = y;
    to[2] = z;
    to[3] = w;
  };
  // A gradient is a combination of two vectors, so three sums give that of the outer products.
  Float4 both_first = zero;
  Float4 mixed = zero;
  Float4 both_second = zero;
  for (std::size_t j = 0; j < size; ++j) {
    const Float4 b = faces.values[1][j] - faces.values[0][j];
    const Float4 c = faces.values[2][j] - faces.values[0][j];
    both_first += b * b;
    mixed += b * c;
    both_second += c * c;
    const Vec3<Float4> gradient = u * b + v * c;
    set_row(2 + j, gradient.x, gradient.y, gradient.z, zero);
  }
  const Vec3<Float4> s = basis.of_first * both_first + basis.of_second * mixed;
  const Vec3<Float4> t = basis.of_first * mixed + basis.of_second * both_second;
  set_row(0, basis.area, s.x * u.x + t.x * v.x, s.x * u.y + t.x * v.y, s.x * u.z + t.x * v.z);
  set_row(1, s.y * u.y + t.y * v.y, s.y * u.z + t.y * v.z, s.z * u.z + t.z * v.z, zero);
}

}  // namespace mesher::simplify
