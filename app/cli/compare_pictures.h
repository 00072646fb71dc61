#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/options.h"
#include "app/document/json.h"
#include "app/files/load_job.h"
#include "engine/analysis/image_difference.h"

namespace mesher::app {

/// The pictures that two models are compared by.
struct PictureComparison {
  std::string folder;  ///< for the pictures; empty: none are drawn
  std::string size;    ///< as LookOptions::size; empty: 800x600
  std::uint32_t views = 24;
  std::string device;  ///< as LookOptions::device
};

/// A direction from which models are seen.
struct ViewAngles {
  double yaw_deg = 0.0;
  double pitch_deg = 0.0;
};
/// Returns directions that are spread evenly over the sphere: a spiral from top to bottom whose
/// steps are equal in height, and turn by the golden angle (R. Swinbank, R. Purser, "Fibonacci
/// grids", 2006). Pre: views > 0.
std::vector<ViewAngles> view_angles(std::uint32_t views);

/// How two models differ from one direction.
struct ViewDifference {
  ViewAngles angles;
  std::string file;  ///< in the folder: the first model, the second, and their difference
  analysis::ImageDifference difference;
};

/// Statistics over views. Views that show nothing of either model do not count.
struct ViewStatistics {
  double median = 0.0;
  double min = 0.0;
  double mean = 0.0;
};

/// How two models differ in one look.
struct LookDifference {
  std::string look;  ///< "textured" or "clay"
  std::vector<ViewDifference> views;

  /// In decibels; infinity if pictures are equal. The mean is that of the squared errors.
  ViewStatistics psnr_db() const;
  ViewStatistics ssim() const;
};

struct PictureDifferences {
  Size size;
  std::string folder;
  std::vector<LookDifference> looks;  ///< textured only if a model has materials or colors
};

/// Draws both models from all directions, framed by the bounds of the first, as `render` draws
/// them: "textured" in the base colors without light, "clay" as one lit gray material with the
/// normals of the file. Writes the first model, the second and four times their difference beside
/// each other, as PNGs that appear all or none. Compares them over the pixels that show either
/// model. Throws UsageError, DeviceError, OutputError; Cancelled.
PictureDifferences compare_pictures(const LoadedModel& a, const LoadedModel& b,
                                    const PictureComparison& options, Progress* progress);

/// Throws UsageError if the options cannot be used, and OutputError if there can be no folder of
/// that name. Call before the work starts.
void check_pictures(const PictureComparison& options);

Json to_json(const PictureDifferences& pictures);
/// A label and what is printed behind it.
std::vector<std::pair<std::string, std::string>> rows_of(const PictureDifferences& pictures);

}  // namespace mesher::app
