#include "app/ui/fonts.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "app/files/paths.h"
#include "app/ui/style.h"

namespace mesher::app {
namespace {

// Size of ImGui's own bitmap font.
constexpr float kBitmapFontPixels = 13.0F;
// ImGui takes the height from ascender to descender as the size, which is 1.164 em in DejaVu Sans.
// Other fonts get the same em, since their ascenders differ: 1.448 em in Noto Sans CJK.
constexpr float kFontHeightEm = 1.164F;

/// Ranges as ImGui takes them: pairs, and a zero at the end.
std::vector<ImWchar> imgui_ranges(const CodePoints& code_points) {
  std::vector<ImWchar> pairs;
  for (const CodeRange& range : code_points.ranges()) {
    pairs.push_back(static_cast<ImWchar>(range.first));
    pairs.push_back(static_cast<ImWchar>(range.last));
  }
  pairs.push_back(0);
  return pairs;
}

/// Adds the font of the panels. `ranges` null: Latin.
void add_base_font(float scale, const ImWchar* ranges) {
  ImGuiIO& io = ImGui::GetIO();
  std::error_code ignored;
  // If the font is missing, ImGui uses its own bitmap font.
  if (std::filesystem::exists(kFontFile, ignored)) {
    io.Fonts->AddFontFromFileTTF(kFontFile, std::round(kFontPoints * scale), nullptr, ranges);
  } else {
    io.Fonts->AddFontDefault();
    io.FontGlobalScale = kFontPoints * scale / kBitmapFontPixels;
  }
}

/// Returns whether the file could be read.
bool add_face(ImFontAtlas& atlas, const FontFace& face, float pixels, ImFontConfig config,
              const ImWchar* ranges) {
  std::error_code ignored;
  // ImGui ends the program for a file that it cannot open.
  if (!std::filesystem::is_regular_file(face.file, ignored)) return false;
  config.FontNo = face.index;
  return atlas.AddFontFromFileTTF(face.file.c_str(), pixels, &config, ranges) != nullptr;
}

/// Returns whether ImGui understands the face, which it may not: for example if it is variable.
bool can_build(const FontFace& face) {
  constexpr ImWchar kNone[] = {' ', ' ', 0};
  ImFontAtlas probe;
  return add_face(probe, face, kBitmapFontPixels, {}, kNone) && probe.Build();
}

/// Adds the glyphs of a face to those of the font before it.
void merge(const FontFace& face, float em_pixels, const std::vector<ImWchar>& ranges) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ImFontConfig config;
  config.MergeMode = true;
  config.OversampleH = 1;  // of thousands of glyphs; CJK is set on whole pixels anyway
  config.PixelSnapH = true;
  // A negative size is that of the em. AddFont refuses it, and the builder takes it.
  if (add_face(atlas, face, em_pixels, config, ranges.data()))
    atlas.ConfigData.back().SizePixels = -em_pixels;
}

}  // namespace

std::size_t most_glyphs(float pixels, std::uint32_t largest_image) {
  constexpr double kMost = 4096.0;
  // Glyphs of the panels' font are three times as wide, and half of the image may stay empty.
  constexpr double kWaste = 2.0 * 3.0;
  const double side = double(pixels) + 2.0;
  const double area = double(largest_image) * double(largest_image);
  return static_cast<std::size_t>(std::min(kMost, area / (kWaste * side * side)));
}

Fonts::Fonts(float scale, std::uint32_t largest_image, Finder find)
    : scale_(scale), largest_image_(largest_image), find_(std::move(find)) {
  add_base_font(scale, nullptr);
}

bool Fonts::require(const CodePoints& shown) {
  if (loaded_.has_all(shown) || shown == refused_) return false;
  const std::size_t most = most_glyphs(std::round(kFontPoints * scale_), largest_image_);
  CodePoints wanted = loaded_;
  wanted.add(shown);
  if (wanted.count() > most) {
    // Names that are no longer shown give way.
    refused_ = shown;
    wanted = shown;
    wanted.truncate(most);
  }
  if (wanted == loaded_) return false;
  loaded_ = wanted;
  is_outdated_ = true;
  return true;
}

void Fonts::set_scale(float scale) {
  is_outdated_ |= scale != scale_;
  scale_ = scale;
}

bool Fonts::update() {
  if (!is_outdated_) return false;
  is_outdated_ = false;
  build();
  if (find_missing()) build();
  return true;
}

void Fonts::build() {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  CodePoints in_base = loaded_;
  in_base.add(CodePoints::kReplacement);
  for (char32_t c = ' '; c < CodePoints::kLatinEnd; ++c)
    in_base.add(c);
  // The builder reads the ranges, so that they are kept until it is done.
  const std::vector<ImWchar> base_ranges = imgui_ranges(in_base);
  add_base_font(scale_, base_ranges.data());
  std::vector<std::vector<ImWchar>> face_ranges;
  for (const FontFace& face : faces_) {
    CodePoints used = loaded_;
    used.keep(face.covers);
    if (used.is_empty()) continue;
    face_ranges.push_back(imgui_ranges(used));
    merge(face, std::round(kFontPoints * scale_ / kFontHeightEm), face_ranges.back());
  }
  atlas.Build();
  // The files of CJK fonts have tens of megabytes.
  atlas.ClearInputData();
}

/// Searches fonts for what has no glyph. Returns whether there are any.
bool Fonts::find_missing() {
  const ImFont& font = *ImGui::GetIO().Fonts->Fonts.front();
  CodePoints missing;
  for (const CodeRange& range : loaded_.ranges()) {
    for (char32_t c = range.first; c <= range.last; ++c) {
      if (!absent_.has(c) && font.FindGlyphNoFallback(static_cast<ImWchar>(c)) == nullptr)
        missing.add(c);
    }
  }
  if (missing.is_empty()) return false;
  std::vector<FontFace> found = find_(missing);
  std::erase_if(found, [](const FontFace& face) { return !can_build(face); });
  absent_.add(missing);
  for (FontFace& face : found) {
    absent_.remove(face.covers);
    faces_.push_back(std::move(face));
  }
  return !found.empty();
}

}  // namespace mesher::app
