#include "app/files/legend_image.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/files/paths.h"

namespace mesher::app {
namespace {

constexpr float kLegendFontPoints = 14.0F;
constexpr float kLegendLinePoints = 17.0F;

/// Latin glyphs of the panels' font, without an ImGui context.
class Glyphs {
 public:
  explicit Glyphs(float pixels) {
    std::error_code ignored;
    // One texel per pixel: text is drawn at whole pixels.
    ImFontConfig config;
    config.OversampleH = 1;
    config.PixelSnapH = true;
    // Without the font, ImGui has one of its own, of one size.
    if (std::filesystem::exists(kFontFile, ignored)) {
      atlas_.AddFontFromFileTTF(kFontFile, pixels, &config);
    } else {
      atlas_.AddFontDefault();
    }
    atlas_.GetTexDataAsAlpha8(&texels_, &width_, &height_);
  }
  float width_of(const std::string& text) const {
    float width = 0.0F;
    for (const char c : text)
      width += glyph(c).AdvanceX;
    return width;
  }
  const ImFontGlyph& glyph(char c) const {
    return *atlas_.Fonts.front()->FindGlyph(static_cast<ImWchar>(static_cast<unsigned char>(c)));
  }
  /// Calls `take(x, y, coverage)` for the pixels of a glyph, from its upper left corner.
  template <class Take>
  void visit(const ImFontGlyph& glyph, Take&& take) const {
    const int u = static_cast<int>(std::lround(glyph.U0 * static_cast<float>(width_)));
    const int v = static_cast<int>(std::lround(glyph.V0 * static_cast<float>(height_)));
    const int columns = static_cast<int>(std::lround(glyph.X1 - glyph.X0));
    const int rows = static_cast<int>(std::lround(glyph.Y1 - glyph.Y0));
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x)
        take(x, y, float(texels_[(v + y) * width_ + u + x]) / 255.0F);
    }
  }

 private:
  ImFontAtlas atlas_;
  unsigned char* texels_ = nullptr;
  int width_ = 0;
  int height_ = 0;
};

/// Blends a color over a pixel with straight alpha.
void blend(std::uint8_t* pixel, const glm::vec3& color, float opacity) {
  const float below = float(pixel[3]) / 255.0F * (1.0F - opacity);
  const float alpha = opacity + below;
  if (alpha <= 0.0F) return;
  const auto byte = [](float value) {
    return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
  };
  for (int i = 0; i < 3; ++i)
    pixel[i] = byte((color[i] * opacity + float(pixel[i]) / 255.0F * below) / alpha);
  pixel[3] = byte(alpha);
}

class ImageCanvas {
 public:
  ImageCanvas(Image& image, float scale) : image_(image), scale_(scale) {}

  /// Rows that are partly covered get a share of the color, so that lines differ in width. Columns
  /// are whole, so that patches side by side leave no seam.
  void fill(const glm::vec2& from, const glm::vec2& to, const glm::vec3& color, float opacity) {
    const glm::vec2 a = scale_ * from;
    const glm::vec2 b = scale_ * to;
    for (int y = int(std::floor(a.y)); y < int(std::ceil(b.y)); ++y) {
      const float high = std::min(b.y, float(y + 1)) - std::max(a.y, float(y));
      for (int x = int(std::lround(a.x)); x < int(std::lround(b.x)); ++x)
        put(x, y, color, opacity * high);
    }
  }
  void text(const Glyphs& glyphs, const glm::vec2& at, const std::string& text,
            const glm::vec3& color) {
    float pen = std::round(scale_ * at.x);
    const float top = std::round(scale_ * at.y);
    for (const char c : text) {
      const ImFontGlyph& glyph = glyphs.glyph(c);
      const int x0 = int(std::lround(pen + glyph.X0));
      const int y0 = int(std::lround(top + glyph.Y0));
      if (glyph.Visible)
        glyphs.visit(glyph, [&](int x, int y, float cover) { put(x0 + x, y0 + y, color, cover); });
      pen += glyph.AdvanceX;
    }
  }

 private:
  void put(int x, int y, const glm::vec3& color, float opacity) {
    if (x < 0 || y < 0 || x >= int(image_.width) || y >= int(image_.height)) return;
    blend(image_.rgba.data() + 4 * (std::size_t(y) * image_.width + std::size_t(x)), color,
          opacity);
  }

  Image& image_;
  float scale_;
};

}  // namespace

Image legend_image(const Legend& legend, float scale, std::uint32_t most_width,
                   std::uint32_t most_height) {
  Image image;
  const float width = std::min(kLegendWidthPoints, std::floor(float(most_width) / scale));
  const float height = legend_height(legend, kLegendLinePoints);
  constexpr float kLeastWidth = 120.0F;
  if (legend.is_empty() || width < kLeastWidth || scale * height > float(most_height)) return image;
  image.width = static_cast<std::uint32_t>(std::lround(scale * width));
  image.height = static_cast<std::uint32_t>(std::lround(scale * height));
  image.rgba.assign(std::size_t{4} * image.width * image.height, 0);
  const Glyphs glyphs(std::round(scale * kLegendFontPoints));
  ImageCanvas canvas(image, scale);
  draw_legend(legend, width,
              {.fill = [&](glm::vec2 from, glm::vec2 to, const render::Color& color,
                           float opacity) { canvas.fill(from, to, color, opacity); },
               .text = [&](glm::vec2 at,
                           const std::string& text) { canvas.text(glyphs, at, text, legend.text); },
               .text_width = [&](const std::string& text) { return glyphs.width_of(text) / scale; },
               .line = kLegendLinePoints});
  return image;
}

void blend_over(Image& rows, std::uint32_t first_row, const Image& image, const glm::uvec2& at) {
  for (std::uint32_t y = 0; y < image.height; ++y) {
    const std::uint32_t row = at.y + y;
    if (row < first_row || row >= first_row + rows.height) continue;
    for (std::uint32_t x = 0; x < image.width && at.x + x < rows.width; ++x) {
      const std::uint8_t* source = image.pixel(x, y);
      std::uint8_t* target =
          rows.rgba.data() + 4 * (std::size_t{row - first_row} * rows.width + at.x + x);
      blend(target, glm::vec3(source[0], source[1], source[2]) / 255.0F, float(source[3]) / 255.0F);
    }
  }
}

}  // namespace mesher::app
