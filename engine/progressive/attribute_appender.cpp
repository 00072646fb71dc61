#include "engine/progressive/attribute_appender.h"

#include <algorithm>
#include <utility>

#include "engine/core/assert.h"

namespace mesher::progressive {
namespace {

/// Makes room for more elements, so that adding them cannot fail.
template <class T>
void make_room(Array<T>& array, std::size_t more) {
  const std::size_t needed = array.size() + more;
  if (needed > array.capacity()) array.reserve(std::max(needed, array.size() + array.size() / 2));
}

void append_values(AttributeLayer& to, const AttributeLayer& from) {
  to.bytes().insert(to.bytes().end(), from.bytes().begin(), from.bytes().end());
}

}  // namespace

void NewSplitAttributes::clear(std::span<const AttributeLayer> types) {
  corner_changes.clear();
  corners.clear();
  group.clear();
  changed.clear();
  new_values.resize(types.size());
  changed_values.resize(types.size());
  for (auto* layers : {&new_values, &changed_values}) {
    for (std::size_t k = 0; k < types.size(); ++k) {
      AttributeLayer& layer = (*layers)[k];
      if (!(layer.type() == types[k].type())) layer = AttributeLayer(types[k].type(), 0);
      layer.resize(0);
    }
  }
}

void AttributeAppender::start(BaseAttributes&& base) {
  to_ = ProgressiveAttributes();
  to_.arrays_.corner_wedge = std::move(base.corner_wedge);
  to_.arrays_.layers = std::move(base.layers);
  to_.is_faceted_ = std::move(base.is_faceted);
  to_.arrays_.group = std::move(base.group);
  to_.arrays_.groups = std::move(base.groups);
  to_.full_wedges_ =
      to_.arrays_.layers.empty() ? 0 : static_cast<std::uint32_t>(to_.arrays_.layers[0].count());
  for (const AttributeLayer& layer : to_.arrays_.layers)
    to_.others_.emplace_back(layer.type(), 0);
}

void AttributeAppender::reserve(std::uint32_t splits) {
  to_.splits_.reserve(splits);
}

void AttributeAppender::append(const NewSplitAttributes& split) {
  MESHER_ASSERT(to_.level() == to_.split_count());
  make_room(to_.splits_, 1);
  make_room(to_.arrays_.corner_wedge, split.corners.size());
  make_room(to_.corner_changes_, split.corner_changes.size());
  make_room(to_.changed_wedges_, split.changed.size());
  make_room(to_.arrays_.group, split.group.size());
  for (std::size_t k = 0; k < to_.arrays_.layers.size(); ++k) {
    make_room(to_.arrays_.layers[k].bytes(), split.new_values[k].bytes().size());
    make_room(to_.others_[k].bytes(), split.changed_values[k].bytes().size());
  }
  to_.splits_.push_back({to_.full_wedges_, static_cast<std::uint32_t>(to_.corner_changes_.size()),
                         static_cast<std::uint32_t>(to_.changed_wedges_.size())});
  to_.arrays_.corner_wedge.insert(to_.arrays_.corner_wedge.end(), split.corners.begin(),
                                  split.corners.end());
  to_.corner_changes_.insert(to_.corner_changes_.end(), split.corner_changes.begin(),
                             split.corner_changes.end());
  to_.changed_wedges_.insert(to_.changed_wedges_.end(), split.changed.begin(), split.changed.end());
  to_.arrays_.group.insert(to_.arrays_.group.end(), split.group.begin(), split.group.end());
  for (std::size_t k = 0; k < to_.arrays_.layers.size(); ++k) {
    append_values(to_.arrays_.layers[k], split.new_values[k]);
    append_values(to_.others_[k], split.changed_values[k]);
  }
  if (!to_.arrays_.layers.empty())
    to_.full_wedges_ = static_cast<std::uint32_t>(to_.arrays_.layers[0].count());
  to_.swap(to_.level_++);
}

}  // namespace mesher::progressive
