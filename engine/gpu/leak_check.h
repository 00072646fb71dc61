#pragma once

namespace mesher::gpu {

/// In builds with AddressSanitizer: tells its leak check which leaks are the validation layer's
/// own, and keeps layer and driver loaded to the end so that they can be told apart. Nothing
/// otherwise.
void excuse_leaks_of_others(bool validation);

}  // namespace mesher::gpu
