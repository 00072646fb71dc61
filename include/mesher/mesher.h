#pragma once

/// @file
/// @brief The whole face of the library.

#include <mesher/asset.h>
#include <mesher/compare.h>
#include <mesher/error.h>
#include <mesher/progress.h>
#include <mesher/progressive_mesh.h>
#include <mesher/render.h>
#include <mesher/simplify.h>
#include <mesher/subdivide.h>
#include <mesher/version.h>
