#include "app/cli/compare_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <memory>
#include <numbers>
#include <optional>

#include "app/cli/batch.h"
#include "app/document/session.h"
#include "app/viewer/scripted_session.h"
#include "engine/core/error.h"
#include "engine/io/png_writer.h"

namespace mesher::app {
namespace {

/// The difference is drawn brighter than it is, so that it can be seen.
constexpr int kBrighter = 4;

Size picture_size_of(const PictureComparison& options) {
  return parse_size(options.size.empty() ? "800x600" : options.size, "--picture-size");
}

/// Returns whether base colors tell more than the shape does.
bool has_colors(const Model& model) {
  const bool has_materials = model.materials != nullptr && !model.materials->materials.empty();
  return has_materials || model.attributes.find(AttributeKind::color) != nullptr;
}

/// Returns whether both sides of a group's faces are shown.
bool is_two_sided(const FaceGroup& group, const Materials* materials) {
  if (materials == nullptr || group.material >= materials->materials.size()) return true;
  return materials->materials[group.material].is_two_sided;
}

/// Returns a gray material that is lit, with one or two sides.
Material gray_material(bool is_two_sided) {
  Material gray;
  gray.base_color = {0.4F, 0.4F, 0.4F, 1.0F};
  gray.metallic = 0.0F;
  gray.roughness = 0.7F;
  gray.is_two_sided = is_two_sided;
  return gray;
}

/// Returns the shape of a model in gray, with the file's normals. Faces keep their number of sides:
/// the two sheets of a leaf would flicker if both were shown from both sides.
Model clay_of(const Model& model) {
  Model clay;
  clay.name = model.name;
  clay.mesh = model.mesh;
  clay.origin = model.origin;
  clay.attributes = model.attributes;
  Attributes& attributes = clay.attributes;
  std::erase_if(attributes.layers, [](const AttributeLayer& layer) {
    return layer.type().kind != AttributeKind::normal;
  });
  if (attributes.group.empty()) {
    attributes.group.assign(model.mesh.face_count(), 0);
    attributes.groups = {FaceGroup{}};
  }
  for (FaceGroup& group : attributes.groups)
    group = {.material = is_two_sided(group, model.materials.get()) ? 1U : 0U};
  Materials materials;
  materials.materials = {gray_material(false), gray_material(true)};
  clay.materials = std::make_shared<const Materials>(std::move(materials));
  return clay;
}

/// The boxes of pictures of two models.
struct Boxes {
  Box framed;  ///< what the pictures show
  Box drawn;   ///< contains both models
};

/// A model that is drawn from one direction after another.
class Drawn {
 public:
  Drawn(Model model, const LoadedModel& loaded, const PictureComparison& options, render::Look look)
      : script_(session_, {.device = options.device}) {
    const Size size = picture_size_of(options);
    session_.view.window = {size.width, size.height};
    session_.view.settings.look = look;
    show_model(session_, std::move(model), loaded.statistics, loaded.file);
    scene_.emplace(script_.scene());
    for (const std::string& line : script_.not_drawn())
      say(loaded.file.filename().string() + ": " + line);
  }

  Image picture(const ViewAngles& angles, const Boxes& boxes) {
    scene_->camera.fit_depth(boxes.drawn);
    scene_->camera.set_angles(glm::radians(angles.yaw_deg), glm::radians(angles.pitch_deg));
    scene_->camera.frame(boxes.framed, session_.view.aspect());
    return draw_picture(*scene_, {.is_transparent = true}, nullptr);
  }

 private:
  Session session_;
  ScriptedSession script_;
  std::optional<PictureScene> scene_;
};

/// Copies an image into a wider one.
void paste(const Image& image, Image& into, std::uint32_t x) {
  for (std::uint32_t y = 0; y < image.height; ++y) {
    const std::uint8_t* row = image.pixel(0, y);
    std::copy(row, row + std::size_t{4} * image.width,
              into.rgba.data() + 4 * (std::size_t{y} * into.width + x));
  }
}

Image brightened_difference(const Image& a, const Image& b) {
  Image result = a;
  for (std::size_t i = 0; i < result.rgba.size(); ++i) {
    const int difference = std::abs(int{a.rgba[i]} - int{b.rgba[i]});
    result.rgba[i] =
        i % 4 == 3 ? 255 : static_cast<std::uint8_t>(std::min(kBrighter * difference, 255));
  }
  return result;
}

Image side_by_side(const Image& a, const Image& b) {
  const Image first = analysis::over_background(a);
  const Image second = analysis::over_background(b);
  Image result{.width = 3 * a.width, .height = a.height, .rgba = {}};
  result.rgba.resize(std::size_t{4} * result.width * result.height);
  paste(first, result, 0);
  paste(second, result, a.width);
  paste(brightened_difference(first, second), result, 2 * a.width);
  return result;
}

using Files = std::vector<std::unique_ptr<io::AtomicFile>>;

void write_png_into(Files& files, const std::filesystem::path& file, const Image& image) {
  files.push_back(std::make_unique<io::AtomicFile>(file));
  io::PngWriter writer(*files.back(), image.width, image.height);
  writer.append(image);
  writer.finish();
}

LookDifference compare_look(const std::string& look, Drawn& a, Drawn& b, const Boxes& boxes,
                            const PictureComparison& options, Files& files, Progress* progress) {
  LookDifference result{.look = look, .views = {}};
  const std::vector<ViewAngles> angles = view_angles(options.views);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    report(progress, static_cast<float>(i) / static_cast<float>(angles.size()));
    const Image first = a.picture(angles[i], boxes);
    const Image second = b.picture(angles[i], boxes);
    const std::string name = fmt::format("{}_{:02}.png", look, i);
    write_png_into(files, std::filesystem::path(options.folder) / name,
                   side_by_side(first, second));
    result.views.push_back({angles[i], name, analysis::image_difference(first, second)});
  }
  return result;
}

ViewStatistics statistics_of(std::vector<double> values, double mean) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const double lower = values[(n - 1) / 2];
  const double upper = values[n / 2];
  // Two infinities have no mean that can be computed.
  return {.median = lower == upper ? lower : 0.5 * (lower + upper),
          .min = values.front(),
          .mean = mean};
}

/// Returns `value(difference)` of each view that shows something.
template <class Value>
std::vector<double> values_of(const std::vector<ViewDifference>& views, const Value& value) {
  std::vector<double> values;
  for (const ViewDifference& view : views) {
    if (view.difference.pixels > 0) values.push_back(value(view.difference));
  }
  return values;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values)
    sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

std::string decibels(double value) {
  return std::isinf(value) ? "equal" : fmt::format("{:.2f}", value);
}

Json statistics_json(const ViewStatistics& s) {
  return {{"median", s.median}, {"min", s.min}, {"mean", s.mean}};
}

}  // namespace

std::vector<ViewAngles> view_angles(std::uint32_t views) {
  MESHER_ASSERT(views > 0);
  const double golden_deg = 180.0 * (3.0 - std::sqrt(5.0));
  std::vector<ViewAngles> angles;
  for (std::uint32_t i = 0; i < views; ++i) {
    const double height = 1.0 - (2.0 * i + 1.0) / views;
    angles.push_back({.yaw_deg = std::fmod(golden_deg * i, 360.0),
                      .pitch_deg = glm::degrees(std::asin(height))});
  }
  return angles;
}

ViewStatistics LookDifference::psnr_db() const {
  const std::vector<double> errors = values_of(
      views, [](const analysis::ImageDifference& difference) { return difference.squared_error; });
  return statistics_of(
      values_of(views, [](const auto& difference) { return difference.psnr_db(); }),
      analysis::psnr_db(mean_of(errors)));
}

ViewStatistics LookDifference::ssim() const {
  const std::vector<double> values =
      values_of(views, [](const analysis::ImageDifference& difference) { return difference.ssim; });
  return statistics_of(values, mean_of(values));
}

void check_pictures(const PictureComparison& options) {
  picture_size_of(options);
  std::error_code error;
  std::filesystem::create_directories(options.folder, error);
  if (error) throw OutputError(options.folder, "cannot be made: " + error.message());
  io::AtomicFile::check(std::filesystem::path(options.folder) / "clay_00.png");
}

PictureDifferences compare_pictures(const LoadedModel& a, const LoadedModel& b,
                                    const PictureComparison& options, Progress* progress) {
  PictureDifferences pictures{picture_size_of(options), options.folder, {}};
  Boxes boxes{.framed = a.statistics.box, .drawn = a.statistics.box};
  extend(boxes.drawn, b.statistics.box, glm::dmat4(1.0));
  const bool has_textured = has_colors(a.model) || has_colors(b.model);
  Stages stages(progress, {has_textured ? 1.0 : 0.0, 1.0});
  Files files;
  stages.next("drawing textures");
  if (has_textured) {
    Drawn first(a.model, a, options, render::Look::base_color);
    Drawn second(b.model, b, options, render::Look::base_color);
    pictures.looks.push_back(
        compare_look("textured", first, second, boxes, options, files, progress));
  }
  stages.next("drawing clay");
  Drawn first(clay_of(a.model), a, options, render::Look::material);
  Drawn second(clay_of(b.model), b, options, render::Look::material);
  pictures.looks.push_back(compare_look("clay", first, second, boxes, options, files, progress));
  seal(progress);
  io::AtomicFile::commit_all(files, io::Flush::later);
  return pictures;
}

Json to_json(const PictureDifferences& pictures) {
  Json json{{"folder", pictures.folder}, {"size", {pictures.size.width, pictures.size.height}}};
  for (const LookDifference& look : pictures.looks) {
    Json views = Json::array();
    for (const ViewDifference& view : look.views) {
      views.push_back({{"yaw_deg", view.angles.yaw_deg},
                       {"pitch_deg", view.angles.pitch_deg},
                       {"pixels", view.difference.pixels},
                       {"psnr_db", view.difference.psnr_db()},
                       {"ssim", view.difference.ssim},
                       {"picture", view.file}});
    }
    json[look.look] = {{"psnr_db", statistics_json(look.psnr_db())},
                       {"ssim", statistics_json(look.ssim())},
                       {"views", std::move(views)}};
  }
  return json;
}

std::vector<std::pair<std::string, std::string>> rows_of(const PictureDifferences& pictures) {
  std::vector<std::pair<std::string, std::string>> rows;
  for (const LookDifference& look : pictures.looks) {
    const ViewStatistics psnr = look.psnr_db();
    const ViewStatistics ssim = look.ssim();
    rows.emplace_back(
        look.look + " PSNR [dB]",
        fmt::format("median {}, min {}, mean {}; SSIM median {:.4f}, min {:.4f}, mean {:.4f}",
                    decibels(psnr.median), decibels(psnr.min), decibels(psnr.mean), ssim.median,
                    ssim.min, ssim.mean));
  }
  return rows;
}

}  // namespace mesher::app
