#include "engine/mesh/build/soup.h"

#include <numeric>
#include <utility>

namespace mesher {

void to_streams(Soup& soup) {
  CornerAttributes& attributes = soup.attributes;
  if (!attributes.has_values()) return;
  AttributeStream& stream = soup.streams.emplace_back();
  const auto take = [&](AttributeType type, auto& values) {
    if (!values.empty())
      stream.layers.emplace_back(std::move(type), std::span(std::as_const(values)));
    values = {};
  };
  take(texcoord_type(), attributes.texcoord);
  take(normal_type(), attributes.normal);
  AttributeType color = color_type();
  color.is_linear = attributes.has_linear_color;
  take(color, attributes.color);
  stream.index.resize(soup.corners.size());
  std::iota(stream.index.begin(), stream.index.end(), 0U);
}

}  // namespace mesher
