#pragma once

/// @file
/// @brief The mark of everything that the shared library exports.

/// Marks what the shared library exports. All else in it is hidden.
#define MESHER_API __attribute__((visibility("default")))
