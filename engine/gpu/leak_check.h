#pragma once

namespace mesher::gpu {

/// Suppresses the validation layer's own leaks in the leak check of AddressSanitizer builds.
///
/// Keeps the layer and the driver loaded until exit, so that their leaks can be identified. Does
/// nothing in other builds.
void suppress_third_party_leaks(bool validation);

}  // namespace mesher::gpu
