#include "engine/analysis/image_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/core/assert.h"
#include "engine/core/parallel.h"

namespace mesher::analysis {
namespace {

/// A gray that neither white paper nor black shadows melt into.
constexpr double kBackground = 128.0;
constexpr int kRadius = 5;
constexpr std::size_t kRows = 16;  // per chunk

using Plane = Array<double>;
using Kernel = std::array<double, 2 * kRadius + 1>;

Kernel gaussian() {
  constexpr double kSigma = 1.5;
  Kernel kernel{};
  double sum = 0.0;
  for (int i = -kRadius; i <= kRadius; ++i)
    sum += kernel[static_cast<std::size_t>(std::int64_t{i} + kRadius)] =
        std::exp(-0.5 * i * i / (kSigma * kSigma));
  for (double& weight : kernel)
    weight /= sum;
  return kernel;
}

/// Calls `body(y)` for each row, in parallel.
template <class Body>
void for_rows(std::uint32_t height, const Body& body) {
  parallel_for_each(height, kRows, body);
}

/// The luma of a picture (ITU-R BT.709).
Plane luma(const Image& image) {
  Plane plane(std::size_t{image.width} * image.height);
  for_rows(image.height, [&](std::uint32_t y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      plane[std::size_t{y} * image.width + x] = 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
    }
  });
  return plane;
}

Plane product(const Plane& a, const Plane& b) {
  Plane result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    result[i] = a[i] * b[i];
  return result;
}

/// Returns the weighted means around each pixel; pixels beyond the border repeat those at it.
Plane blurred(const Plane& plane, std::uint32_t width, std::uint32_t height) {
  const Kernel kernel = gaussian();
  const auto pass = [&](const Plane& from, int step_x, int step_y) {
    Plane to(from.size());
    for_rows(height, [&](std::uint32_t y) {
      for (std::uint32_t x = 0; x < width; ++x) {
        double sum = 0.0;
        for (int i = -kRadius; i <= kRadius; ++i) {
          const auto at_x = std::clamp(static_cast<std::int64_t>(x) + i * step_x, std::int64_t{0},
                                       std::int64_t{width} - 1);
          const auto at_y = std::clamp(static_cast<std::int64_t>(y) + i * step_y, std::int64_t{0},
                                       std::int64_t{height} - 1);
          sum += kernel[static_cast<std::size_t>(std::int64_t{i} + kRadius)] *
                 from[static_cast<std::size_t>(at_y) * width + static_cast<std::size_t>(at_x)];
        }
        to[std::size_t{y} * width + x] = sum;
      }
    });
    return to;
  };
  return pass(pass(plane, 1, 0), 0, 1);
}

/// Returns the structural similarity around each pixel.
Plane similarity(const Image& a, const Image& b) {
  constexpr double kC1 = 0.01 * 255.0 * 0.01 * 255.0;
  constexpr double kC2 = 0.03 * 255.0 * 0.03 * 255.0;
  const auto blur = [&](const Plane& plane) { return blurred(plane, a.width, a.height); };
  const Plane x = luma(a);
  const Plane y = luma(b);
  const Plane mean_x = blur(x);
  const Plane mean_y = blur(y);
  Plane result = blur(product(x, y));
  const Plane square_x = blur(product(x, x));
  const Plane square_y = blur(product(y, y));
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double means = mean_x[i] * mean_y[i];
    const double squares = mean_x[i] * mean_x[i] + mean_y[i] * mean_y[i];
    const double covariance = result[i] - means;
    const double variances = square_x[i] + square_y[i] - squares;
    result[i] =
        (2.0 * means + kC1) * (2.0 * covariance + kC2) / ((squares + kC1) * (variances + kC2));
  }
  return result;
}

struct Errors {
  std::uint64_t pixels = 0;
  double squares = 0.0;
  double similarity = 0.0;
  Errors& operator+=(const Errors& other) {
    pixels += other.pixels;
    squares += other.squares;
    similarity += other.similarity;
    return *this;
  }
};

double squared_error(const std::uint8_t* a, const std::uint8_t* b) {
  double sum = 0.0;
  for (int c = 0; c < 3; ++c)
    sum += (double(a[c]) - double(b[c])) * (double(a[c]) - double(b[c]));
  return sum;
}

}  // namespace

double psnr_db(double squared_error) {
  if (!(squared_error > 0.0)) return std::numeric_limits<double>::infinity();
  return 10.0 * std::log10(255.0 * 255.0 / squared_error);
}

double ImageDifference::psnr_db() const {
  return analysis::psnr_db(squared_error);
}

Image over_background(const Image& image) {
  Image result = image;
  for (std::size_t i = 0; i < result.rgba.size(); i += 4) {
    const double alpha = result.rgba[i + 3] / 255.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double color = alpha * result.rgba[i + c] + (1.0 - alpha) * kBackground;
      result.rgba[i + c] = static_cast<std::uint8_t>(std::lround(color));
    }
    result.rgba[i + 3] = 255;
  }
  return result;
}

ImageDifference image_difference(const Image& a, const Image& b) {
  MESHER_ASSERT(a.width == b.width && a.height == b.height);
  const Image laid_a = over_background(a);
  const Image laid_b = over_background(b);
  const Plane similar = similarity(laid_a, laid_b);
  const auto sum = parallel_sum<Errors>(a.height, kRows, [&](IndexRange rows) {
    Errors errors;
    for (std::size_t i = rows.begin * a.width; i < rows.end * a.width; ++i) {
      if (a.rgba[4 * i + 3] == 0 && b.rgba[4 * i + 3] == 0) continue;
      errors += {1, squared_error(&laid_a.rgba[4 * i], &laid_b.rgba[4 * i]), similar[i]};
    }
    return errors;
  });
  if (sum.pixels == 0) return {};
  const auto n = static_cast<double>(sum.pixels);
  return {
      .pixels = sum.pixels, .squared_error = sum.squares / (3.0 * n), .ssim = sum.similarity / n};
}

}  // namespace mesher::analysis
