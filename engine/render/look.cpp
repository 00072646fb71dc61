#include "engine/render/look.h"

namespace mesher::render {

Look drawn_look(const Settings& settings, const Attributes* attributes,
                const Materials* materials) {
  if (attributes == nullptr || settings.shading == Shading::none) return Look::clay;
  const auto has = [&](AttributeKind kind) { return attributes->find(kind) != nullptr; };
  if (settings.look == Look::automatic) {
    const bool has_materials = materials != nullptr && !materials->materials.empty();
    return has_materials || has(AttributeKind::color) ? Look::material : Look::clay;
  }
  if (settings.look == Look::uv_checker && !has(AttributeKind::texcoord)) return Look::clay;
  return settings.look;
}

}  // namespace mesher::render
