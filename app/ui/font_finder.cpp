#include "app/ui/font_finder.h"

#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <string_view>
#include <utility>

namespace mesher::app {
namespace {

template <class T, void (*destroy)(T*)>
struct FcDeleter {
  void operator()(T* object) const { destroy(object); }
};
using ConfigHandle = std::unique_ptr<FcConfig, FcDeleter<FcConfig, FcConfigDestroy>>;
using PatternHandle = std::unique_ptr<FcPattern, FcDeleter<FcPattern, FcPatternDestroy>>;
using CharSetHandle = std::unique_ptr<FcCharSet, FcDeleter<FcCharSet, FcCharSetDestroy>>;
using FontSetHandle = std::unique_ptr<FcFontSet, FcDeleter<FcFontSet, FcFontSetDestroy>>;

/// The pattern that fontconfig compares fonts with: an upright sans-serif face with these code
/// points.
PatternHandle pattern_for(const CodePoints& wanted) {
  CharSetHandle charset(FcCharSetCreate());
  for (const CodeRange& range : wanted.ranges()) {
    for (char32_t c = range.first; c <= range.last; ++c)
      FcCharSetAddChar(charset.get(), c);
  }
  PatternHandle pattern(FcPatternCreate());
  FcPatternAddString(pattern.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>("sans-serif"));
  FcPatternAddCharSet(pattern.get(), FC_CHARSET, charset.get());
  FcPatternAddBool(pattern.get(), FC_OUTLINE, FcTrue);
  return pattern;
}

CodePoints covered_by(FcPattern* font) {
  CodePoints covered;
  FcCharSet* charset = nullptr;
  if (FcPatternGetCharSet(font, FC_CHARSET, 0, &charset) != FcResultMatch) return covered;
  std::array<FcChar32, FC_CHARSET_MAP_SIZE> map{};
  FcChar32 next = 0;
  for (FcChar32 page = FcCharSetFirstPage(charset, map.data(), &next); page != FC_CHARSET_DONE;
       page = FcCharSetNextPage(charset, map.data(), &next)) {
    for (FcChar32 i = 0; i < 32 * map.size(); ++i) {
      if ((map[i / 32] >> (i % 32) & 1U) != 0) covered.add(page + i);
    }
  }
  return covered;
}

/// Returns whether the file is one that ImGui's font reader knows. fontconfig also lists Type 1,
/// bitmap and compressed fonts, and ImGui ends the program when it is given one of those.
bool is_readable(const std::filesystem::path& file) {
  std::array<char, 4> magic{};
  std::ifstream(file, std::ios::binary).read(magic.data(), magic.size());
  constexpr std::array<std::string_view, 4> kKnown{{{"\0\1\0\0", 4}, "true", "OTTO", "ttcf"}};
  return std::ranges::count(kKnown, std::string_view(magic.data(), magic.size())) > 0;
}

/// Returns the face of a font, without its code points; an empty file if it cannot be used.
FontFace face_of(FcPattern* font) {
  FcChar8* file = nullptr;
  int index = 0;
  FcBool is_outline = FcFalse;
  if (FcPatternGetString(font, FC_FILE, 0, &file) != FcResultMatch ||
      FcPatternGetInteger(font, FC_INDEX, 0, &index) != FcResultMatch ||
      FcPatternGetBool(font, FC_OUTLINE, 0, &is_outline) != FcResultMatch || is_outline != FcTrue)
    return {};
  // The upper half says which instance of a variable font it is.
  constexpr int kFaceMask = 0xFFFF;
  return {.file = reinterpret_cast<const char*>(file), .index = index & kFaceMask, .covers = {}};
}

}  // namespace

std::vector<FontFace> find_faces(const CodePoints& wanted) {
  std::vector<FontFace> faces;
  // A configuration of our own: it is freed below, while fontconfig would keep the global one.
  const ConfigHandle config(FcInitLoadConfigAndFonts());
  if (!config) return faces;
  const PatternHandle pattern = pattern_for(wanted);
  FcConfigSubstitute(config.get(), pattern.get(), FcMatchPattern);
  FcDefaultSubstitute(pattern.get());
  FcResult result = FcResultNoMatch;
  // Without trimming: a font that ImGui cannot read must not hide one that it can.
  const FontSetHandle fonts(FcFontSort(config.get(), pattern.get(), FcFalse, nullptr, &result));
  if (!fonts) return faces;
  CodePoints missing = wanted;
  for (int i = 0; i < fonts->nfont && !missing.is_empty(); ++i) {
    CodePoints covered = covered_by(fonts->fonts[i]);
    CodePoints gained = covered;
    gained.keep(missing);
    if (gained.is_empty()) continue;
    FontFace face = face_of(fonts->fonts[i]);
    if (face.file.empty() || !is_readable(face.file)) continue;
    missing.remove(gained);
    face.covers = covered;
    faces.push_back(std::move(face));
  }
  return faces;
}

}  // namespace mesher::app
