#pragma once

#include <cstdint>
#include <optional>

#include "engine/mesh/mesh.h"

namespace mesher::app {

/// The root mean square distance of about 4,096 points of `input` (centers of faces, by area) from
/// the surface of `result`, in model units; 0 where one of them has no faces. O(F log F) of the
/// result, O(F) of the input.
double distance_from_input(const Mesh& input, const Mesh& result);

/// A result of more faces than this is near its input, so that it need not be measured.
inline constexpr std::uint32_t kManyFaces = 20'000;

/// That distance in percent of `diagonal`, where it passes kFarFromInput and the result has few
/// faces; else none.
std::optional<double> far_percent(const Mesh& input, const Mesh& result, double diagonal);

}  // namespace mesher::app
