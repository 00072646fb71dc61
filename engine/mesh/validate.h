#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/mesh/attributes.h"
#include "engine/mesh/mesh.h"

namespace mesher {

/// A violated invariant of Mesh: its number and a description of the location.
struct Violation {
  int invariant = 0;
  std::string what;
};

/// Returns the violated invariants of Mesh (numbered in engine/mesh/mesh.h), at most `limit`
/// entries; empty: the mesh is valid. Never crashes, whatever the arrays hold. O(F log F).
std::vector<Violation> validate(const Mesh& mesh, std::size_t limit = 20);

/// Returns the violated invariants of a valid mesh's attributes (numbered in
/// engine/mesh/attributes.h), at most one per invariant. O(F).
std::vector<Violation> validate(const Mesh& mesh, const Attributes& attributes);

}  // namespace mesher
