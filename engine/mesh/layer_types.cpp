#include "engine/mesh/layer_types.h"

#include <algorithm>

namespace mesher {

AttributeType common_type(AttributeType a, const AttributeType& b) {
  if (a == b) return a;
  a.components = std::max(a.components, b.components);
  if (a.component != b.component || a.is_normalized != b.is_normalized) {
    a.component = a.kind == AttributeKind::joints ? ComponentType::u16 : ComponentType::f32;
    a.is_normalized = false;
  }
  return a;
}

void append_converted(AttributeLayer& to, const AttributeLayer& from) {
  const std::size_t before = to.count();
  to.resize(before + from.count());
  if (to.type() == from.type()) {
    std::ranges::copy(from.bytes(), to.value(before).data());
    return;
  }
  const bool lacks_alpha =
      to.type().kind == AttributeKind::color && from.type().components < to.type().components;
  for (std::size_t i = 0; i < from.count(); ++i) {
    AttributeValue value = load(from, i);
    if (lacks_alpha) value[3] = 1.0;
    store(to, before + i, value);
  }
}

}  // namespace mesher
