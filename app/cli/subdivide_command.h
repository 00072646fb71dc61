#pragma once

#include <string>

#include "app/cli/options.h"
#include "engine/subdivide/options.h"

namespace mesher::app {

/// Reads a model, subdivides it and its attributes, writes it, and reports. Throws DeviceError if
/// the result needs more memory than is free.
void run_subdivide(const InputOptions& input, const std::string& output,
                   const subdivide::SubdivideOptions& options, const CommonOptions& common);

}  // namespace mesher::app
