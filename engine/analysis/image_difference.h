#pragma once

#include <cstdint>

#include "engine/core/image.h"

namespace mesher::analysis {

/// How much two pictures differ where either of them shows the model.
struct ImageDifference {
  std::uint64_t pixels = 0;    ///< of the foreground: alpha is above 0 in either picture
  double squared_error = 0.0;  ///< mean over the foreground and its three channels, 0 to 255^2
  double ssim = 1.0;           ///< mean over the foreground; 1: equal

  /// Returns the peak signal-to-noise ratio in decibels; infinity if the pictures are equal.
  double psnr_db() const;
};

/// Returns the PSNR of a mean squared error of 8-bit channels; infinity for 0.
double psnr_db(double squared_error);

/// Compares two pictures of one size with straight alpha, both laid over one opaque color. Errors
/// are those of the sRGB bytes. The structural similarity is that of the luma, within Gaussian
/// windows of 11 x 11 pixels (Z. Wang, A. Bovik, H. Sheikh, E. Simoncelli, "Image quality
/// assessment: from error visibility to structural similarity", 2004). O(pixels), parallel; the
/// same for any number of threads. Pre: the sizes agree.
ImageDifference image_difference(const Image& a, const Image& b);

/// Returns a picture with straight alpha laid over the color that image_difference uses.
Image over_background(const Image& image);

}  // namespace mesher::analysis
