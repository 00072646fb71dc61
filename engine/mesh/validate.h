#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/mesh/mesh.h"

namespace mesher {

/// A broken invariant of Mesh: its number there, and where.
struct Violation {
  int invariant = 0;
  std::string what;
};

/// Checks every invariant of Mesh (numbered in engine/mesh/mesh.h). Returns what is broken, at most
/// `limit` entries; empty: the mesh is sound. Never crashes, whatever the arrays hold.
/// O(F log F) time.
std::vector<Violation> validate(const Mesh& mesh, std::size_t limit = 20);

}  // namespace mesher
