#include "engine/progressive/codec/pm_write.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "engine/core/error.h"
#include "engine/progressive/codec/attribute_coder.h"
#include "engine/progressive/codec/pm_base.h"
#include "engine/progressive/codec/pm_format.h"
#include "engine/progressive/codec/range_coder.h"
#include "engine/progressive/codec/split_coder.h"

namespace mesher::progressive {
namespace {

/// Times of coarsening to the base, and of coding the splits.
constexpr double kCodeWeights[] = {0.02, 0.98};

constexpr std::uint32_t kFirstBlockSplits = 64;
constexpr std::uint32_t kLargestBlockSplits = kPmMostBlockSplits;

/// Restores the level of a mesh or of attributes on scope exit, also after exceptions.
template <class Leveled>
class LevelKept {
 public:
  explicit LevelKept(Leveled& it) : it_(it), level_(it.level()) {}
  ~LevelKept() { it_.go_to(level_); }
  LevelKept(const LevelKept&) = delete;
  LevelKept& operator=(const LevelKept&) = delete;

 private:
  Leveled& it_;
  std::uint32_t level_;
};

[[noreturn]] void refuse(std::string_view reason) {
  throw OutputError("", reason);
}

/// Returns the grid over the bounding box of all levels. Pre: at the base.
PmGrid grid_of(const ProgressiveMesh& mesh, unsigned bits) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  glm::vec3 low(infinity);
  glm::vec3 high(-infinity);
  const auto add = [&](const glm::vec3& p) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  };
  for (const glm::vec3& p : mesh.mesh().positions())
    add(p);
  for (const VertexSplit& split : mesh.splits()) {
    add(split.fine_position);
    add(split.child_position);
  }
  PmGrid grid{.step = 1.0};
  if (!(low.x <= high.x)) return grid;
  double side = 0.0;
  for (int i = 0; i < 3; ++i) {
    grid.origin[i] = low[i];
    side = std::max(side, double{high[i]} - double{low[i]});
  }
  if (side > 0.0) grid.step = side / ((std::uint32_t{1} << bits) - 1);
  return grid;
}

class PmWriter {
 public:
  PmWriter(ProgressiveMesh& mesh, const PmWriteOptions& options, const ByteSink& sink)
      : mesh_(mesh), options_(options), sink_(sink) {
    ProgressiveAttributes* const given = options.attributes;
    MESHER_ASSERT(given == nullptr || given->layers().empty() ||
                  given->split_count() == mesh.split_count());
    if (given != nullptr && !given->is_empty()) attributes_ = given;
  }

  PmSizes run() {
    if (attributes_ == nullptr) return write_all();
    const LevelKept<ProgressiveAttributes> kept(*attributes_);
    attributes_->go_to(0);
    return write_all();
  }

 private:
  PmSizes write_all() {
    Stages stages(options_.progress, kCodeWeights);
    stages.next();
    const LevelKept<ProgressiveMesh> kept(mesh_);
    go_to_level(mesh_, 0, options_.progress);
    stages.next();
    make_header();
    PmBase base{MeshArrays::take(Mesh(mesh_.mesh())), {}};
    if (header_.is_quantized()) {
      for (const glm::vec3& p : base.arrays.position)
        base.grid.push_back(header_.grid.numbers(p, header_.coordinate_bits));
    }
    write_base(base);
    if (header_.has_attributes()) write_base_attributes();
    sizes_.base = sizes_.total;
    write_splits(std::move(base.grid));
    if (coder_) note_sizes(coder_->bits());
    return std::move(sizes_);
  }

  void make_header() {
    const Mesh& base = mesh_.mesh();
    const auto is_sharp = [](float sharpness) { return sharpness > 0.0F; };
    const bool is_base_sharp =
        std::any_of(base.sharpnesses().begin(), base.sharpnesses().end(), is_sharp);
    if (is_base_sharp || !mesh_.sharpnesses().empty()) header_.flags |= kPmSharpEdges;
    if (!base.vertex_sharpnesses().empty()) header_.flags |= kPmSharpVertices;
    if (attributes_ != nullptr || !options_.appendix.empty()) header_.flags |= kPmAttributes;
    header_.coordinate_bits = options_.coordinate_bits;
    header_.base_vertices = base.vertex_count();
    header_.base_faces = base.face_count();
    header_.splits = mesh_.split_count();
    if (header_.is_quantized()) header_.grid = grid_of(mesh_, options_.coordinate_bits);
  }

  void write_base(const PmBase& base) {
    const Array<std::byte> payload = encode_base(header_, base);
    if (payload.size() > kNone) refuse("the base mesh is too large for a progressive mesh's file");
    write(pm_bytes(header_, payload));
    write(payload);
    check_ = header_.base_check;
  }

  void write_base_attributes() {
    AttributeTable table;
    if (attributes_ != nullptr)
      table = make_table(*attributes_, header_.is_quantized() ? &options_.rounding : nullptr);
    if (table.layers.size() > kPmMostLayers)
      refuse("a progressive mesh has at most 255 attributes");
    for (const LayerFormat& layer : table.layers) {
      if (!is_layer_name(layer.type.name))
        refuse("the name of an attribute is empty, longer than 256 bytes, or POSITION");
    }
    for (const LayerFormat& layer : table.layers)
      sizes_.layers.push_back({layer.type.name, layer.bits, 0});
    const Array<std::byte> table_bytes = encode_table(table);
    coder_ = std::make_unique<AttributeCoder<RangeEncoder>>(header_, std::move(table), built_,
                                                            attributes_);
    RangeEncoder encoder;
    const std::string_view why = coder_->code_base(encoder, mesh_.mesh(), 0);
    if (!why.empty()) refuse(why);
    const Array<std::byte> payload = encoder.finish(coder_->least_bytes());
    coder_->note_bytes(payload.size());
    const std::span<const std::byte> parts[] = {table_bytes, payload, options_.appendix};
    for (const auto& part : parts) {
      if (part.size() >= kNone)
        refuse("the attributes are too large for a progressive mesh's file");
    }
    PmBaseAttributesHeader head{static_cast<std::uint32_t>(table_bytes.size()),
                                static_cast<std::uint32_t>(payload.size()),
                                static_cast<std::uint32_t>(options_.appendix.size()), 0};
    const auto unchecked = pm_bytes(head);
    check_ = pm_check(check_, std::span(unchecked).first(kPmBaseAttributesHeaderBytes - 4));
    for (const auto& part : parts)
      check_ = pm_check(check_, part);
    head.check = check_;
    const std::uint64_t before = sizes_.total;
    write(pm_bytes(head));
    for (const auto& part : parts)
      write(part);
    sizes_.attributes += sizes_.total - before;
    sizes_.appendix = options_.appendix.size();
  }

  /// Writes the attributes of a block.
  void write_attributes(RangeEncoder& encoder) {
    const Array<std::byte> payload = encoder.finish(coder_->least_bytes());
    if (payload.size() >= kNone) refuse("the attributes of splits do not fit into a block");
    coder_->note_bytes(payload.size());
    PmAttributesHeader head{static_cast<std::uint32_t>(payload.size()), 0};
    const auto unchecked = pm_bytes(head);
    check_ = pm_check(check_, std::span(unchecked).first(kPmAttributesHeaderBytes - 4));
    head.check = check_ = pm_check(check_, payload);
    const std::uint64_t before = sizes_.total;
    write(pm_bytes(head));
    write(payload);
    sizes_.attributes += sizes_.total - before;
  }

  void note_sizes(const AttributeBits& bits) {
    const auto bytes = [](double count) { return static_cast<std::uint64_t>(count / 8.0 + 0.5); };
    sizes_.wedges = bytes(bits.wedges);
    sizes_.groups = bytes(bits.groups);
    for (std::size_t k = 0; k < bits.layers.size(); ++k)
      sizes_.layers[k].bytes = bytes(bits.layers[k]);
  }

  void write_splits(Array<glm::ivec3>&& grid) {
    SplitCoder<RangeEncoder> coder(header_, std::move(grid));
    std::uint32_t size = kFirstBlockSplits;
    for (std::uint32_t begin = 0; begin < header_.splits;) {
      const std::uint32_t count = std::min(size, header_.splits - begin);
      write_block(coder, begin + count);
      begin += count;
      size = std::min(2 * size, kLargestBlockSplits);
      report(options_.progress, static_cast<float>(begin) / static_cast<float>(header_.splits));
    }
    sizes_.splits = sizes_.total - sizes_.base;
  }

  void write_block(SplitCoder<RangeEncoder>& coder, std::uint32_t end) {
    const std::uint32_t count = end - mesh_.level();
    RangeEncoder encoder;
    RangeEncoder attribute_encoder;
    coder.begin_block(mesh_.level(), end);
    if (coder_) coder_->begin_block(end, 0);
    while (mesh_.level() < end) {
      NewSplit split = mesh_.next_split();
      const std::string_view why = coder.code(encoder, mesh_, split);
      if (!why.empty()) refuse(why);
      mesh_.go_to(mesh_.level() + 1);
      if (attributes_ == nullptr) continue;
      attributes_->go_to(mesh_.level());
      const std::string_view bad = coder_->code_split(attribute_encoder, mesh_);
      if (!bad.empty()) refuse(bad);
    }
    const Array<std::byte> payload = encoder.finish(pm_least_bytes(count));
    if (payload.size() > pm_most_bytes(count)) refuse("splits do not fit into a block");
    check_ = pm_block_check(check_, count, payload);
    write(pm_bytes(PmBlockHeader{static_cast<std::uint32_t>(payload.size()), count, check_}));
    write(payload);
    if (header_.has_attributes()) write_attributes(attribute_encoder);
  }

  void write(std::span<const std::byte> bytes) {
    sink_(bytes);
    sizes_.total += bytes.size();
  }

  ProgressiveMesh& mesh_;
  const PmWriteOptions& options_;
  const ByteSink& sink_;
  ProgressiveAttributes* attributes_ = nullptr;
  ProgressiveAttributes built_;  ///< as a reader will have them
  std::unique_ptr<AttributeCoder<RangeEncoder>> coder_;
  PmHeader header_;
  std::uint32_t check_ = 0;
  PmSizes sizes_;
};

}  // namespace

PmSizes write_pm(ProgressiveMesh& mesh, const PmWriteOptions& options, const ByteSink& sink) {
  MESHER_ASSERT(options.coordinate_bits == 0 ||
                (options.coordinate_bits >= kPmLeastCoordinateBits &&
                 options.coordinate_bits <= kPmMostCoordinateBits));
  begin_stage(options.progress, "coding");
  return PmWriter(mesh, options, sink).run();
}

}  // namespace mesher::progressive
