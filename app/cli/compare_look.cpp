#include "app/cli/compare_look.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/text.h"
#include "engine/io/image_header.h"

namespace mesher::app {
namespace {

double larger(double forward, double backward) {
  return std::max(forward, backward);
}

/// Calls `figures(spread)` for both directions, and returns the larger of each figure as well.
template <class Figures>
Json two_sided_json(const analysis::TwoSidedSpread& spread, const Figures& figures) {
  Json forward = figures(spread.forward);
  Json backward = figures(spread.backward);
  Json both = Json::object();
  for (const auto& [key, value] : forward.items())
    both[key] = larger(value.template get<double>(), backward[key].template get<double>());
  return {{"two_sided", std::move(both)},
          {"forward", std::move(forward)},
          {"backward", std::move(backward)}};
}

double percentile(const analysis::TwoSidedSpread& spread, double share) {
  return larger(spread.forward.percentile(share), spread.backward.percentile(share));
}

Json slide_json(const analysis::Spread& spread) {
  return {{"p50", spread.percentile(0.5)},
          {"p90", spread.percentile(0.9)},
          {"p99", spread.percentile(0.99)},
          {"max", spread.max()}};
}

}  // namespace

std::vector<analysis::FaceTexture> face_textures(const Model& model) {
  std::vector<analysis::FaceTexture> textures;
  for (const FaceGroup& group : model.attributes.groups) {
    analysis::FaceTexture& texture = textures.emplace_back();
    if (model.materials == nullptr || group.material >= model.materials->materials.size()) continue;
    const Texture& base = model.materials->materials[group.material].base_color_texture;
    if (!base.is_there()) continue;
    texture.set = base.set;
    texture.texels = glm::dvec2(analysis::FaceTexture::kNominal);
    if (base.image < model.materials->images.size()) {
      const EncodedImage& image = model.materials->images[base.image];
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
  return analysis::look_deviation({a.mesh, a.attributes, of_a}, {b.mesh, b.attributes, of_b},
                                  {.samples = samples, .progress = progress});
}

void add_look(Json& json, const analysis::LookDeviation& look) {
  if (look.uv_slide) json["uv_slide_texels"] = two_sided_json(*look.uv_slide, slide_json);
  json["not_measured"] = look.not_measured;
}

std::vector<std::pair<std::string, std::string>> rows_of(const analysis::LookDeviation& look) {
  std::vector<std::pair<std::string, std::string>> rows;
  if (look.uv_slide) {
    rows.emplace_back(
        "UV slide [texels]",
        fmt::format("50 % {}, 90 % {}, 99 % {}", number_text(percentile(*look.uv_slide, 0.5)),
                    number_text(percentile(*look.uv_slide, 0.9)),
                    number_text(percentile(*look.uv_slide, 0.99))));
  }
  for (const std::string& line : look.not_measured)
    rows.emplace_back("not measured", line);
  return rows;
}

}  // namespace mesher::app
