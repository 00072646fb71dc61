#include "app/document/stand_in.h"

#include "engine/simplify/clustering.h"

namespace mesher::app {
namespace {

// A software renderer on two cores draws them in less than 33 ms.
constexpr std::uint32_t kFaces = 60'000;

}  // namespace

std::shared_ptr<const Mesh> make_stand_in(const Mesh& mesh, const Statistics& statistics) {
  return std::make_shared<const Mesh>(simplify::cluster(mesh, statistics, kFaces));
}

}  // namespace mesher::app
