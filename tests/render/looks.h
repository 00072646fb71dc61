#pragma once

#include "engine/render/settings.h"

namespace mesher::render {

// The looks that most tests draw with.
inline const Settings kFlat{.shading = Shading::flat};
inline const Settings kGouraud{.shading = Shading::gouraud};
inline const Settings kFlatWire{.shading = Shading::flat, .wireframe = true};
inline const Settings kGouraudWire{.shading = Shading::gouraud, .wireframe = true};

}  // namespace mesher::render
