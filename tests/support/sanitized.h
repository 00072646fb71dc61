#pragma once

namespace mesher::test {

/// Whether the sanitizers are on. They make everything several times slower, so that tests of large
/// sizes use smaller ones under them: the release build runs the full sizes.
#ifdef MESHER_SANITIZED
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace mesher::test
