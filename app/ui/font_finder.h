#pragma once

#include <filesystem>
#include <vector>

#include "app/ui/code_points.h"

namespace mesher::app {

/// A face of a font file of the system.
struct FontFace {
  std::filesystem::path file;
  int index = 0;      ///< of the face in a collection
  CodePoints covers;  ///< all code points that it has a glyph for
};

/// Asks fontconfig for faces with glyphs for `wanted`. Returns as few faces as cover what can be
/// covered, the preferred ones first. They are outline fonts that ImGui can read (TrueType and
/// OpenType). Takes some tens of milliseconds, because it reads fontconfig's configuration.
std::vector<FontFace> find_faces(const CodePoints& wanted);

}  // namespace mesher::app
