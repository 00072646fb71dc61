#include "engine/progressive/codec/attribute_coder.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/array.h"
#include "engine/progressive/attribute_appender.h"
#include "engine/progressive/codec/attribute_fit.h"
#include "engine/progressive/codec/group_coder.h"
#include "engine/progressive/codec/layer_coder.h"
#include "engine/progressive/codec/split_wedges.h"
#include "engine/progressive/codec/wedge_coder.h"

namespace mesher::progressive {
namespace {

/// Number of corners whose faces a prediction takes into account.
constexpr std::size_t kMostFitCorners = 64;
/// Number of wedges of a parent that a split fits. Nearly all splits need one or two; in a hostile
/// file, a parent has thousands.
constexpr std::size_t kMostFits = 16;
/// Number of wedges whose values a split may change.
constexpr std::size_t kMostChanged = 2;

/// By how much of the child's deviation from its prediction the parent's differs in the other
/// direction.
constexpr double kOpposite = 0.5;

constexpr std::string_view kBadValue = "a value of an attribute is outside its range";
constexpr std::string_view kManyValues = "more values of attributes than the file may hold";

}  // namespace

template <class Coder>
struct AttributeCoder<Coder>::State {
  PmHeader header;
  AttributeTable table;
  ProgressiveAttributes& built;
  const ProgressiveAttributes* source;
  AttributeAppender appender;
  WedgeCoder wedge_coder;
  GroupCoder base_groups;
  GroupCoder split_groups;
  AdaptiveBitModel base_is_last;
  AdaptiveBitModel base_is_new;
  AdaptiveBitModel changes[16];
  std::vector<LayerCoder> layers;
  SplitWedges wedges;
  std::array<AttributeFit, kMostFits> fits;
  std::vector<std::uint32_t> fitted;  ///< the wedge of the parent of each fit of the split
  std::vector<FitSample> samples;
  std::vector<std::uint32_t> new_order;
  NewSplitAttributes next;
  AttributeBits bits;
  std::uint64_t wedge_bytes;
  std::uint64_t value_bytes = 0;    ///< of all wedges so far
  std::uint64_t payload_bytes = 0;  ///< of all payloads so far
  std::uint64_t changed_corners = 0;
  std::uint64_t most_changes = 0;  ///< corners, up to the end of the block

  State(const PmHeader& h, AttributeTable&& t, ProgressiveAttributes& to,
        const ProgressiveAttributes* from)
      : header(h),
        table(std::move(t)),
        built(to),
        source(from),
        appender(to),
        wedge_bytes(table.wedge_bytes()) {
    bits.layers.resize(table.layers.size());
    for (const LayerFormat& format : table.layers)
      layers.emplace_back(format);
  }

  /// Adds what has been coded since `begin` to a sum.
  static void measure(const Coder& coder, double& begin, double& sum) {
    if constexpr (!Coder::kDecodes) {
      const double end = coder.bits_so_far();
      sum += end - begin;
      begin = end;
    }
  }
  static double begin_measure(const Coder& coder) {
    if constexpr (Coder::kDecodes) {
      return 0.0;
    } else {
      return coder.bits_so_far();
    }
  }

  /// Returns a position as a reader has it.
  glm::dvec3 position(const glm::vec3& p) const {
    if constexpr (!Coder::kDecodes) {
      if (header.is_quantized()) return glm::dvec3(header.grid.nearest(p, header.coordinate_bits));
    }
    return glm::dvec3(p);
  }
  std::span<const std::byte> actual(std::size_t layer, Wedge w) const {
    if constexpr (Coder::kDecodes) {
      return {};
    } else {
      return source->layers()[layer].value(w.index());
    }
  }

  /// Counts the values of a wedge. Returns false if the payloads are too short for them.
  bool count_values() {
    value_bytes += wedge_bytes;
    return !Coder::kDecodes || value_bytes <= pm_most_value_bytes(payload_bytes);
  }

  std::string_view code_base_wedges(Coder& coder, const Mesh& mesh, BaseAttributes& base,
                                    std::vector<Wedge>& near);
  std::string_view code_base_values(Coder& coder, BaseAttributes& base,
                                    const std::vector<Wedge>& near);
  void code_base_groups(Coder& coder, const Mesh& mesh, BaseAttributes& base);

  AttributeFit* fit_of(const ProgressiveMesh& mesh, std::uint32_t i, std::uint32_t wedge);
  std::string_view code_values(Coder& coder, const ProgressiveMesh& mesh, std::uint32_t i,
                               const WedgeCoder::NewCorners& corners);
  bool code_wedge(Coder& coder, ValueRole role, const SplitWedge& w, AttributeFit* fit,
                  const glm::dvec3& at, std::span<const Wedge> mates,
                  std::vector<AttributeLayer>& to);
  void code_split_groups(Coder& coder, const ProgressiveMesh& mesh, std::uint32_t i);
};

template <class Coder>
std::string_view AttributeCoder<Coder>::State::code_base_wedges(Coder& coder, const Mesh& mesh,
                                                                BaseAttributes& base,
                                                                std::vector<Wedge>& near) {
  Array<Wedge> last;  // by vertex
  last.assign(mesh.vertex_count(), Wedge{});
  std::uint32_t count = 0;
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const Vertex v = mesh.origin(Halfedge(h));
    Wedge& known = last[v.index()];
    Wedge w = Coder::kDecodes ? Wedge{} : source->corner_wedges()[h];
    const bool is_last = known.is_valid() && coder.bit(base_is_last, w == known);
    if (is_last) {
      w = known;
    } else if (!known.is_valid() || coder.bit(base_is_new, w.index() >= count)) {
      MESHER_ASSERT(Coder::kDecodes || w.index() == count);
      w = Wedge(count++);
      wedge_coder.note(w, v);
      near.push_back(known);
    } else {
      w = Wedge(coder.uniform(w.index(), count));
      if (wedge_coder.vertex(w) != v) return "a corner has a wedge of another vertex";
    }
    known = w;
    base.corner_wedge.push_back(w);
  }
  // Values follow those of a wedge in the same face, or else those of the wedge before.
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const Wedge w = base.corner_wedge[h];
    Wedge& its = near[w.index()];
    const std::uint32_t face = h - h % 3;
    for (std::uint32_t c = face; !its.is_valid() && c < face + 3; ++c) {
      if (base.corner_wedge[c] < w) its = base.corner_wedge[c];
    }
  }
  return {};
}

template <class Coder>
std::string_view AttributeCoder<Coder>::State::code_base_values(Coder& coder, BaseAttributes& base,
                                                                const std::vector<Wedge>& near) {
  for (const LayerFormat& format : table.layers) {
    base.layers.emplace_back(format.type, 0);
    base.is_faceted.push_back(format.is_faceted ? 1 : 0);
  }
  double begin = begin_measure(coder);
  for (std::uint32_t w = 0; w < near.size(); ++w) {
    if (!count_values()) return kManyValues;
    const Wedge from = near[w].is_valid() ? near[w] : Wedge(w - 1);
    for (std::size_t k = 0; k < layers.size(); ++k) {
      AttributeLayer& layer = base.layers[k];
      layer.resize(w + std::size_t{1});
      const auto before =
          w == 0 ? std::span<const std::byte>{} : std::as_const(layer).value(from.index());
      if (!layers[k].code_base(coder, before, actual(k, Wedge(w)), layer.value(w)))
        return kBadValue;
      measure(coder, begin, bits.layers[k]);
    }
  }
  return {};
}

template <class Coder>
void AttributeCoder<Coder>::State::code_base_groups(Coder& coder, const Mesh& mesh,
                                                    BaseAttributes& base) {
  const auto count = static_cast<std::uint32_t>(table.groups.size());
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const std::uint32_t last = f == 0 ? kNone : base.group[f - 1];
    base.group.push_back(
        base_groups.code(coder, last, kNone, Coder::kDecodes ? 0 : source->group()[f], count));
  }
}

/// Returns the fit of a wedge that the parent had, or null: there is no such wedge, or the split
/// has fitted as many as it may.
template <class Coder>
AttributeFit* AttributeCoder<Coder>::State::fit_of(const ProgressiveMesh& pm, std::uint32_t i,
                                                   std::uint32_t wedge) {
  if (wedge == kNone) return nullptr;
  const auto known = std::ranges::find(fitted, wedge);
  if (known != fitted.end()) return &fits[static_cast<std::size_t>(known - fitted.begin())];
  if (fitted.size() == kMostFits) return nullptr;
  AttributeFit& fit = fits[fitted.size()];
  fitted.push_back(wedge);
  const Mesh& mesh = pm.mesh();
  const SplitWedge& w = wedges.wedges[wedge];
  samples.clear();
  std::uint32_t c = w.first_corner;
  for (std::size_t n = 0; n < kMostFitCorners && c != kNone; ++n, c = wedges.corners[c].next) {
    const Halfedge h = wedges.corners[c].corner;
    for (const Halfedge other : {Mesh::next(h), Mesh::prev(h)}) {
      samples.push_back(
          {position(mesh.position(mesh.origin(other))), built.corner_wedges()[other.index()]});
    }
  }
  fit.fit(built.layers(), position(pm.splits()[i].coarse_position), w.wedge, samples);
  return &fit;
}

template <class Coder>
bool AttributeCoder<Coder>::State::code_wedge(Coder& coder, ValueRole role, const SplitWedge& w,
                                              AttributeFit* fit, const glm::dvec3& at,
                                              std::span<const Wedge> mates,
                                              std::vector<AttributeLayer>& to) {
  double begin = begin_measure(coder);
  std::size_t component = 0;
  const std::uint32_t first_new = built.wedge_count(built.level());
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const AttributeType& type = table.layers[k].type;
    // First of all, because it may move the values that the prediction refers to.
    const std::size_t slot = to[k].count();
    to[k].resize(slot + 1);
    PredictedValue predicted;
    predicted.source = built.layers()[k].value(w.near.index());
    const RawValue before = raw_value(type, predicted.source);
    for (std::size_t c = 0; c < type.components; ++c) {
      predicted.mean[c] = before[c];
      if (fit == nullptr) continue;
      fit->predict(component + c, at, predicted.mean[c], predicted.variance[c]);
      if (role == ValueRole::changed) predicted.mean[c] -= kOpposite * fit->noted(component + c);
    }
    // Faces with one value have the same at all three corners.
    for (const Wedge mate : mates) {
      if (mate.index() >= first_new && mate < w.wedge)
        predicted.mate = std::as_const(next.new_values[k]).value(mate.index() - first_new);
    }
    if (!layers[k].code(coder, role, predicted, actual(k, w.wedge), to[k].value(slot)))
      return false;
    if (fit != nullptr && role == ValueRole::child) {
      const RawValue coded = raw_value(type, std::as_const(to[k]).value(slot));
      for (std::size_t c = 0; c < type.components; ++c) {
        const double difference = coded[c] - predicted.mean[c];
        fit->note(component + c, std::isfinite(difference) ? difference : 0.0);
      }
    }
    component += type.components;
    measure(coder, begin, bits.layers[k]);
  }
  return true;
}

template <class Coder>
std::string_view AttributeCoder<Coder>::State::code_values(Coder& coder, const ProgressiveMesh& pm,
                                                           std::uint32_t i,
                                                           const WedgeCoder::NewCorners& corners) {
  const VertexSplit& split = pm.splits()[i];
  const Vertex child = pm.child(i);
  const glm::dvec3 at_child = position(split.child_position);
  const glm::dvec3 at_parent = position(split.fine_position);
  fitted.clear();
  std::vector<std::uint32_t>& order = new_order;
  order.clear();
  for (std::uint32_t w = 0; w < wedges.wedges.size(); ++w) {
    if (wedges.wedges[w].is_new) order.push_back(w);
  }
  std::ranges::sort(order, {}, [&](std::uint32_t w) { return wedges.wedges[w].wedge; });
  for (const std::uint32_t index : order) {
    SplitWedge& w = wedges.wedges[index];
    if (!count_values()) return kManyValues;
    if (w.source != kNone) w.near = wedges.wedges[w.source].wedge;
    const ValueRole role = w.owner == child ? ValueRole::child : ValueRole::other;
    std::span<const Wedge> mates;
    for (std::size_t c = 0; c < corners.size() && mates.empty(); ++c) {
      if (corners[c] == w.wedge) mates = std::span(corners).subspan(c < 3 ? 0 : 3, 3);
    }
    const glm::dvec3& at = w.owner == child ? at_child : at_parent;
    if (!code_wedge(coder, role, w, fit_of(pm, i, w.source), at, mates, next.new_values))
      return kBadValue;
  }
  double begin = begin_measure(coder);
  const bool is_moved = at_parent != position(split.coarse_position);
  std::span<const Wedge> changed;
  if constexpr (!Coder::kDecodes) changed = source->changed_wedges(i);
  MESHER_ASSERT(changed.size() <= kMostChanged);
  for (std::uint32_t index = 0; index < wedges.old_wedges; ++index) {
    if (next.changed.size() == kMostChanged) break;
    const SplitWedge& w = wedges.wedges[index];
    const std::size_t context = (is_moved ? 1U : 0U) + (wedges.old_wedges > 1 ? 2U : 0U) +
                                (w.owner == child ? 4U : 0U) + (w.at_child != kNone ? 8U : 0U);
    const bool changes_value =
        coder.bit(changes[context], std::ranges::find(changed, w.wedge) != changed.end());
    measure(coder, begin, bits.wedges);
    if (!changes_value) continue;
    if (!count_values()) return kManyValues;
    next.changed.push_back(w.wedge);
    const glm::dvec3& at = w.owner == child ? at_child : at_parent;
    if (!code_wedge(coder, ValueRole::changed, w, fit_of(pm, i, w.source), at, {},
                    next.changed_values)) {
      return kBadValue;
    }
    begin = begin_measure(coder);
  }
  return {};
}

template <class Coder>
void AttributeCoder<Coder>::State::code_split_groups(Coder& coder, const ProgressiveMesh& pm,
                                                     std::uint32_t i) {
  const VertexSplit& split = pm.splits()[i];
  const auto count = static_cast<std::uint32_t>(table.groups.size());
  const auto group_of = [&](Halfedge h) {
    return h.is_valid() ? built.group()[Mesh::face(h).index()] : kNone;
  };
  const std::uint32_t faces = pm.face_count(i + 1) - split.first_face;
  for (std::uint32_t f = 0; f < faces; ++f) {
    const std::uint32_t actual_group = Coder::kDecodes ? 0 : source->group()[split.first_face + f];
    next.group.push_back(split_groups.code(coder, group_of(split.beyond[2 * f]),
                                           group_of(split.beyond[2 * f + 1]), actual_group, count));
  }
}

template <class Coder>
AttributeCoder<Coder>::AttributeCoder(const PmHeader& header, AttributeTable&& table,
                                      ProgressiveAttributes& built,
                                      const ProgressiveAttributes* source)
    : state_(std::make_unique<State>(header, std::move(table), built, source)) {}

template <class Coder>
AttributeCoder<Coder>::~AttributeCoder() = default;

template <class Coder>
void AttributeCoder<Coder>::reserve(std::uint32_t splits) {
  state_->appender.reserve(splits);
}

template <class Coder>
std::string_view AttributeCoder<Coder>::code_base(Coder& coder, const Mesh& mesh,
                                                  std::uint64_t bytes) {
  State& s = *state_;
  s.payload_bytes = bytes;
  BaseAttributes base;
  if (!s.layers.empty()) {
    std::vector<Wedge> near;
    double begin = State::begin_measure(coder);
    if (const auto why = s.code_base_wedges(coder, mesh, base, near); !why.empty()) return why;
    State::measure(coder, begin, s.bits.wedges);
    if (const auto why = s.code_base_values(coder, base, near); !why.empty()) return why;
  }
  if (s.table.has_face_groups) {
    double begin = State::begin_measure(coder);
    s.code_base_groups(coder, mesh, base);
    State::measure(coder, begin, s.bits.groups);
  }
  base.groups = s.table.groups;
  s.appender.start(std::move(base));
  return {};
}

template <class Coder>
void AttributeCoder<Coder>::begin_block(std::uint32_t end, std::uint64_t bytes) {
  state_->payload_bytes += bytes;
  state_->most_changes = pm_most_moved(end);
}

template <class Coder>
std::string_view AttributeCoder<Coder>::code_split(Coder& coder, const ProgressiveMesh& pm) {
  State& s = *state_;
  const std::uint32_t i = s.built.level();
  s.next.clear(s.built.layers());
  if (!s.layers.empty()) {
    double begin = State::begin_measure(coder);
    s.wedges.gather(pm, i, s.built);
    WedgeCoder::NewCorners corners;
    const auto why = s.wedge_coder.code(coder, pm, i, s.built, s.source, s.wedges, corners);
    if (!why.empty()) return why;
    State::measure(coder, begin, s.bits.wedges);
    const auto change = [&](const SplitCorner& c) {
      const Wedge before = s.wedges.wedges[c.before].wedge;
      const Wedge after = s.wedges.wedges[c.after].wedge;
      if (before != after) s.next.corner_changes.push_back({c.corner, after});
    };
    const std::span<const SplitCorner> all = s.wedges.corners;
    std::ranges::for_each(all.subspan(s.wedges.moved), change);
    std::ranges::for_each(all.first(s.wedges.moved), change);
    s.changed_corners += s.next.corner_changes.size();
    if (s.changed_corners > s.most_changes) return "splits change too many corners";
    s.next.corners.assign(corners.begin(), corners.begin() + (s.wedges.is_pair ? 6 : 3));
    if (const auto bad = s.code_values(coder, pm, i, corners); !bad.empty()) return bad;
  }
  if (s.table.has_face_groups) {
    double begin = State::begin_measure(coder);
    s.code_split_groups(coder, pm, i);
    State::measure(coder, begin, s.bits.groups);
  }
  s.appender.append(s.next);
  return {};
}

template <class Coder>
std::uint64_t AttributeCoder<Coder>::least_bytes() const {
  return pm_least_value_payload(state_->value_bytes, state_->payload_bytes);
}

template <class Coder>
void AttributeCoder<Coder>::note_bytes(std::uint64_t bytes) {
  state_->payload_bytes += bytes;
}

template <class Coder>
const AttributeBits& AttributeCoder<Coder>::bits() const {
  return state_->bits;
}

template class AttributeCoder<RangeEncoder>;
template class AttributeCoder<RangeDecoder>;

}  // namespace mesher::progressive
