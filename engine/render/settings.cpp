#include "engine/render/settings.h"

namespace mesher::render {

Color background_color(Background background) {
  return background == Background::light ? Color(0.955F, 0.958F, 0.965F)
                                         : Color(0.110F, 0.118F, 0.133F);
}

Color edge_color(const Settings& settings) {
  const bool on_dark = settings.shading == Shading::none && settings.background == Background::dark;
  return on_dark ? Color(0.80F, 0.82F, 0.85F) : Color(0.12F, 0.13F, 0.15F);
}

}  // namespace mesher::render
