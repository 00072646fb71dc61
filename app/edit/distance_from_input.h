#pragma once

#include <cstdint>
#include <optional>

#include "engine/mesh/mesh.h"

namespace mesher::app {

/// Returns the RMS distance of at most 4,096 points of `input` (centers of faces, weighted by area)
/// from the surface of `result`, in model units; 0 if either mesh has no faces. O(F log F) in the
/// faces of `result`, O(F) in those of `input`.
double distance_from_input(const Mesh& input, const Mesh& result);

/// A result with more faces than this is near its input, so that it is not measured.
inline constexpr std::uint32_t kManyFaces = 20'000;

/// Returns that distance in percent of `diagonal` if it exceeds kFarFromInput. Returns none if it
/// does not, or if the result has more than kManyFaces faces.
std::optional<double> far_percent(const Mesh& input, const Mesh& result, double diagonal);

}  // namespace mesher::app
