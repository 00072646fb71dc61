#include "engine/analysis/predicates.h"

#include <array>
#include <cstddef>

namespace mesher::analysis::detail {
namespace {

/// A rounded number and its rounding error: the sum is exact.
struct Pair {
  double high;
  double low;
};

Pair exact_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

Pair exact_difference(double a, double b) {
  return exact_sum(a, -b);
}

/// Returns the upper and the lower half of the bits.
Pair halves(double a) {
  constexpr double kSplitter = 0x1p27 + 1.0;
  const double scaled = kSplitter * a;
  const double high = scaled - (scaled - a);
  return {high, a - high};
}

Pair exact_product(double a, double b) {
  const double product = a * b;
  const auto [a_high, a_low] = halves(a);
  const auto [b_high, b_low] = halves(b);
  const double rest = ((product - a_high * b_high) - a_low * b_high) - a_high * b_low;
  return {product, a_low * b_low - rest};
}

/// A sum of nonzero doubles that do not overlap in bits, by increasing magnitude.
template <std::size_t kMostTerms>
class Expansion {
 public:
  void add(double value) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const Pair sum = exact_sum(value, terms_[i]);
      if (sum.low != 0.0) terms_[kept++] = sum.low;
      value = sum.high;
    }
    if (value != 0.0) terms_[kept++] = value;
    size_ = kept;
  }
  void add_product(double a, double b) {
    const Pair product = exact_product(a, b);
    add(product.low);
    add(product.high);
  }
  void add_product(const Pair& a, const Pair& b) {
    add_product(a.low, b.low);
    add_product(a.low, b.high);
    add_product(a.high, b.low);
    add_product(a.high, b.high);
  }
  template <std::size_t kTerms>
  void add_product(const Expansion<kTerms>& a, const Pair& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      add_product(a.term(i), b.low);
      add_product(a.term(i), b.high);
    }
  }

  std::size_t size() const { return size_; }
  double term(std::size_t i) const { return terms_[i]; }
  int sign() const { return size_ == 0 ? 0 : detail::sign(terms_[size_ - 1]); }

 private:
  std::array<double, kMostTerms> terms_;  // initialized up to size_
  std::size_t size_ = 0;
};

Pair negative(const Pair& a) {
  return {-a.high, -a.low};
}

/// Returns a b - c d: at most 16 terms.
Expansion<16> determinant(const Pair& a, const Pair& b, const Pair& c, const Pair& d) {
  Expansion<16> result;
  result.add_product(a, b);
  result.add_product(negative(c), d);
  return result;
}

}  // namespace

int exact_orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  const Pair ax = exact_difference(a.x, c.x);
  const Pair ay = exact_difference(a.y, c.y);
  const Pair bx = exact_difference(b.x, c.x);
  const Pair by = exact_difference(b.y, c.y);
  return determinant(ax, by, ay, bx).sign();
}

int exact_orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                      const glm::dvec3& d) {
  const auto difference = [&](const glm::dvec3& p) -> std::array<Pair, 3> {
    return {exact_difference(p.x, a.x), exact_difference(p.y, a.y), exact_difference(p.z, a.z)};
  };
  const auto u = difference(b);
  const auto v = difference(c);
  const auto w = difference(d);
  // Three products of 16 terms by 2, each of which adds two terms.
  Expansion<192> sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    sum.add_product(determinant(u[j], v[k], u[k], v[j]), w[i]);
  }
  return sum.sign();
}

}  // namespace mesher::analysis::detail
