#pragma once

namespace mesher::app {

/// What takes edits away.
enum class Leaving {
  close,  ///< the shown model is closed
  quit,   ///< all models are closed
};

}  // namespace mesher::app
