#include "app/cli/compare_look.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>

#include "engine/core/text.h"
#include "engine/io/image_header.h"

namespace mesher::app {
namespace {

/// All samples of the look are kept in memory, 50 bytes each.
constexpr std::uint64_t kMostLookSamples = 5'000'000;

using analysis::Spread;
using analysis::TwoSidedSpread;

/// A figure of a measure.
using Figure = double (*)(const Spread& spread);

double mean(const Spread& spread) {
  return spread.mean();
}
double rms(const Spread& spread) {
  return spread.rms();
}
double most(const Spread& spread) {
  return spread.max();
}
template <int kPercent>
double percentile(const Spread& spread) {
  return spread.percentile(kPercent / 100.0);
}

/// Returns the larger figure of both directions.
double two_sided(const TwoSidedSpread& spread, Figure figure) {
  return std::max(figure(spread.forward), figure(spread.backward));
}

/// Figures with their keys.
using Figures = std::vector<std::pair<const char*, Figure>>;

Json figures_json(const Spread& spread, const Figures& figures) {
  Json json = Json::object();
  for (const auto& [key, figure] : figures)
    json[key] = figure(spread);
  return json;
}

Json figures_json(const TwoSidedSpread& spread, const Figures& figures) {
  Json both = Json::object();
  for (const auto& [key, figure] : figures)
    both[key] = two_sided(spread, figure);
  return {{"two_sided", std::move(both)},
          {"forward", figures_json(spread.forward, figures)},
          {"backward", figures_json(spread.backward, figures)}};
}

const char* source_of_normals(bool is_of_file) {
  return is_of_file ? "file" : "faces";
}

double percent_of(double part, double whole) {
  return whole > 0.0 ? 100.0 * part / whole : 0.0;
}

/// Returns the texture deviation in model units, and each figure in percent of the diagonal too.
Json texture_json(const analysis::LookDeviation& look, double diagonal) {
  Json json = figures_json(*look.texture, {{"rms", rms}, {"p95", percentile<95>}, {"max", most}});
  for (auto& [direction, figures] : json.items()) {
    Json percents = Json::object();
    for (const auto& [key, value] : figures.items())
      percents[key + "_percent"] = percent_of(value.get<double>(), diagonal);
    figures.update(percents);
  }
  json["covered_percent"] = 100.0 * look.texture_covered;
  return json;
}

Json stretch_json(const analysis::UvStretch& stretch) {
  return {{"l2", stretch.mean.rms()},
          {"l2_p95", stretch.mean.percentile(0.95)},
          {"linf", stretch.worst.max()},
          {"linf_p95", stretch.worst.percentile(0.95)}};
}

Json flipped_json(const analysis::FlippedUvs& flipped) {
  return {{"faces", flipped.flipped},
          {"compared_faces", flipped.compared},
          {"area_percent", percent_of(flipped.flipped_area, flipped.compared_area)}};
}

/// A figure as text, with four digits.
std::string figure_text(double value) {
  return fmt::format("{:.4g}", value);
}

std::string texture_text(const analysis::LookDeviation& look, double diagonal) {
  const auto text = [&](Figure figure) {
    const double value = two_sided(*look.texture, figure);
    return fmt::format("{} ({})", figure_text(value), percent_text(percent_of(value, diagonal)));
  };
  return fmt::format("rms {}, 95 % {}, max {}; over {} of the area", text(rms),
                     text(percentile<95>), text(most), percent_text(100.0 * look.texture_covered));
}

/// Returns a number that tells images apart, also those of different models.
std::uint64_t key_of(const EncodedImage& image) {
  const std::hash<std::string_view> hash;
  return image.bytes == nullptr ? hash(image.name) : hash(*image.bytes);
}

}  // namespace

std::vector<analysis::FaceTexture> face_textures(const Model& model) {
  std::vector<analysis::FaceTexture> textures;
  std::vector<std::uint64_t> keys;
  if (model.materials != nullptr) {
    for (const EncodedImage& image : model.materials->images)
      keys.push_back(key_of(image));
  }
  for (const FaceGroup& group : model.attributes.groups) {
    analysis::FaceTexture& texture = textures.emplace_back();
    if (model.materials == nullptr || group.material >= model.materials->materials.size()) continue;
    const Texture& base = model.materials->materials[group.material].base_color_texture;
    if (!base.is_there()) continue;
    texture.set = base.set;
    texture.texels = glm::dvec2(analysis::FaceTexture::kNominal);
    if (base.image < model.materials->images.size()) {
      const EncodedImage& image = model.materials->images[base.image];
      texture.image = keys[base.image];
      if (image.bytes != nullptr) {
        const io::ImageHeader header = io::read_image_header(*image.bytes);
        if (header.width > 0 && header.height > 0) texture.texels = {header.width, header.height};
      }
    }
    texture.texels *= glm::abs(glm::dvec2(base.scale));
  }
  return textures;
}

analysis::LookDeviation look_deviation(const Model& a, const Model& b, std::uint64_t samples,
                                       Progress* progress) {
  const std::vector<analysis::FaceTexture> of_a = face_textures(a);
  const std::vector<analysis::FaceTexture> of_b = face_textures(b);
  return analysis::look_deviation(
      {a.mesh, a.attributes, of_a}, {b.mesh, b.attributes, of_b},
      {.samples = std::min(samples, kMostLookSamples), .progress = progress});
}

void add_look(Json& json, const analysis::LookDeviation& look, double diagonal) {
  if (look.normals) {
    Json& normals = json["normal_deviation_deg"];
    normals = figures_json(*look.normals, {{"mean", mean}, {"p95", percentile<95>}, {"max", most}});
    normals["first_normals"] = source_of_normals(look.first_has_normals);
    normals["second_normals"] = source_of_normals(look.second_has_normals);
  }
  if (look.texture) json["texture_deviation"] = texture_json(look, diagonal);
  if (look.uv_slide) {
    json["uv_slide_texels"] = figures_json(
        *look.uv_slide,
        {{"p50", percentile<50>}, {"p90", percentile<90>}, {"p99", percentile<99>}, {"max", most}});
  }
  if (look.stretch) json["uv_stretch"] = stretch_json(*look.stretch);
  if (look.flipped) json["flipped_uvs"] = flipped_json(*look.flipped);
  if (look.overlap) {
    json["uv_overlap_percent"] = {{"first", 100.0 * look.overlap->original},
                                  {"second", 100.0 * look.overlap->second},
                                  {"new", 100.0 * look.overlap->added}};
  }
  if (look.colors) {
    const Figures figures{{"mean", mean}, {"p95", percentile<95>}, {"max", most}};
    json["color_difference"] = {{"cie76", figures_json(look.colors->cie76, figures)},
                                {"ciede2000", figures_json(look.colors->ciede2000, figures)}};
  }
  Json missing = Json::object();
  for (const analysis::NotMeasured& one : look.not_measured)
    missing[one.what] = one.why;
  json["not_measured"] = std::move(missing);
}

std::vector<std::pair<std::string, std::string>> rows_of(const analysis::LookDeviation& look,
                                                         double diagonal) {
  std::vector<std::pair<std::string, std::string>> rows;
  const auto both = [](const TwoSidedSpread& spread, Figure figure) {
    return figure_text(two_sided(spread, figure));
  };
  if (look.normals) {
    rows.emplace_back("normals [deg]",
                      fmt::format("mean {}, 95 % {}, max {}", both(*look.normals, mean),
                                  both(*look.normals, percentile<95>), both(*look.normals, most)));
  }
  if (look.texture) rows.emplace_back("texture deviation", texture_text(look, diagonal));
  if (look.uv_slide) {
    rows.emplace_back(
        "UV slide [texels]",
        fmt::format("50 % {}, 90 % {}, 99 % {}", both(*look.uv_slide, percentile<50>),
                    both(*look.uv_slide, percentile<90>), both(*look.uv_slide, percentile<99>)));
  }
  if (look.stretch) {
    rows.emplace_back("UV stretch",
                      fmt::format("L2 {}, 95 % {}, max {}", figure_text(look.stretch->mean.rms()),
                                  figure_text(look.stretch->mean.percentile(0.95)),
                                  figure_text(look.stretch->worst.max())));
  }
  if (look.flipped) {
    rows.emplace_back("flipped UVs", fmt::format("{} of {}", count_text(look.flipped->flipped),
                                                 count_text(look.flipped->compared, "face")));
  }
  if (look.overlap) {
    rows.emplace_back("UV overlap", fmt::format("{} of the texture, before {}, new {}",
                                                percent_text(100.0 * look.overlap->second),
                                                percent_text(100.0 * look.overlap->original),
                                                percent_text(100.0 * look.overlap->added)));
  }
  if (look.colors) {
    rows.emplace_back(
        "vertex colors [dE]",
        fmt::format("CIE76 mean {}, 95 % {}; CIEDE2000 mean {}, 95 % {}",
                    both(look.colors->cie76, mean), both(look.colors->cie76, percentile<95>),
                    both(look.colors->ciede2000, mean),
                    both(look.colors->ciede2000, percentile<95>)));
  }
  for (const analysis::NotMeasured& one : look.not_measured)
    rows.emplace_back("not measured", one.why);
  return rows;
}

}  // namespace mesher::app
