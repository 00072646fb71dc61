#pragma once

#include <cstdint>
#include <string>

#include "app/cli/options.h"
#include "engine/mesh/model.h"
#include "engine/subdivide/options.h"

namespace mesher::app {

/// Throws DeviceError if a subdivision does not fit into memory beside `held` bytes. Returns the
/// bytes of its result. O(F).
std::uint64_t check_memory(const Model& model, const subdivide::SubdivideOptions& options,
                           std::uint64_t held = 0);

/// Subdivides a model and its attributes in place. Returns whether it lost tangents. Throws
/// Cancelled.
bool subdivide_model(Model& model, const subdivide::SubdivideOptions& options);

/// Prints on stderr what was done.
void say_subdivided(const subdivide::SubdivideOptions& options, double seconds,
                    bool drops_tangents);

/// Reads a model, subdivides it and its attributes, writes it, and reports. Throws DeviceError if
/// the result needs more memory than is free.
void run_subdivide(const InputOptions& input, const std::string& output,
                   const subdivide::SubdivideOptions& options, const CommonOptions& common);

}  // namespace mesher::app
