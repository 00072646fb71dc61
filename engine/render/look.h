#pragma once

#include "engine/mesh/attributes.h"
#include "engine/mesh/material.h"
#include "engine/render/settings.h"

namespace mesher::render {

/// Returns the look that a model is drawn in with these settings: never Look::automatic. It is clay
/// if there are no attributes, no surface, or no texture coordinates for a checkerboard. The
/// pointers may be null.
Look drawn_look(const Settings& settings, const Attributes* attributes, const Materials* materials);

}  // namespace mesher::render
