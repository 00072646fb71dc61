#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "app/ui/code_points.h"
#include "app/ui/font_finder.h"

namespace mesher::app {

/// Returns how many glyphs besides Latin fit into an image of `largest_image` pixels a side, but at
/// most some thousands. `pixels`: height of the font.
std::size_t most_glyphs(float pixels, std::uint32_t largest_image);

/// ImGui's glyphs. It begins with Latin. Glyphs of other scripts are added when a name needs them:
/// from the panels' font, or else from a font of the system that is searched for then. There can be
/// one at a time, while there is an ImGui context.
class Fonts {
 public:
  using Finder = std::function<std::vector<FontFace>(const CodePoints&)>;

  /// `scale`: ImGui's units per point. `largest_image`: the largest width and height of an image on
  /// the device. `find`: searches the system's fonts.
  Fonts(float scale, std::uint32_t largest_image, Finder find = find_faces);

  /// Asks for the glyphs of the code points that a frame shows. Returns whether `update` has to add
  /// some. Code points without a glyph are asked for once.
  bool require(const CodePoints& shown);
  /// Asks for another size.
  void set_scale(float scale);
  /// Builds ImGui's atlas again if something was asked for. Returns whether it did, so that the
  /// texture has to be uploaded again. Call between frames.
  bool update();
  /// Returns the code points that have been asked for and have no glyph.
  const CodePoints& absent() const { return absent_; }

 private:
  void build();
  bool find_missing();

  float scale_;
  std::uint32_t largest_image_;
  Finder find_;
  bool is_outdated_ = false;
  CodePoints loaded_;            ///< what the atlas was asked for
  CodePoints refused_;           ///< more than fits; shown in the last frame
  CodePoints absent_;            ///< of those, what no font has
  std::vector<FontFace> faces_;  ///< in addition to the font of the panels
};

}  // namespace mesher::app
