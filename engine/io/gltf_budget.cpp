#include "engine/io/gltf_budget.h"

#include <nlohmann/json.hpp>

#include "engine/io/gltf_contents.h"
#include "engine/mesh/ids.h"

namespace mesher::io {
namespace {

/// Beyond what is always allowed, the limit per byte of the file. A value that is not repeated
/// takes at least one byte.
constexpr std::size_t kMostPerByte = 8;

}  // namespace

void GltfBudget::spend(const GltfFile& gltf, std::size_t values) {
  spent_ += values;
  if (spent_ > kAlwaysAllowed && spent_ / kMostPerByte > gltf.byte_count()) {
    gltf.fail(refusal_);
  }
  if (spent_ >= kNone) gltf.fail("more elements than 32-bit indices can address");
}

double primitive_work(const GltfFile& gltf, const GltfFile::Json& primitive) {
  return GltfBudget::kPrimitiveCost + static_cast<double>(claimed_elements(gltf, primitive));
}

double mesh_work(const GltfFile& gltf, std::uint64_t mesh) {
  double work = 1.0;
  const GltfFile::Json& json = gltf.element("meshes", mesh);
  const auto primitives = json.find("primitives");
  if (primitives == json.end() || !primitives->is_array()) return work;
  for (const GltfFile::Json& primitive : *primitives)
    work += primitive_work(gltf, primitive);
  return work;
}

}  // namespace mesher::io
