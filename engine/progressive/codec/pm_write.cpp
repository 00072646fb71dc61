#include "engine/progressive/codec/pm_write.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "engine/core/error.h"
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

/// Restores the mesh's level on scope exit, also after exceptions.
class LevelKept {
 public:
  explicit LevelKept(ProgressiveMesh& mesh) : mesh_(mesh), level_(mesh.level()) {}
  ~LevelKept() { mesh_.go_to(level_); }
  LevelKept(const LevelKept&) = delete;
  LevelKept& operator=(const LevelKept&) = delete;

 private:
  ProgressiveMesh& mesh_;
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
      : mesh_(mesh), options_(options), sink_(sink) {}

  PmSizes run() {
    Stages stages(options_.progress, kCodeWeights);
    stages.next();
    const LevelKept kept(mesh_);
    go_to_level(mesh_, 0, options_.progress);
    stages.next();
    make_header();
    PmBase base{MeshArrays::take(Mesh(mesh_.mesh())), {}};
    if (header_.is_quantized()) {
      for (const glm::vec3& p : base.arrays.position)
        base.grid.push_back(header_.grid.numbers(p, header_.coordinate_bits));
    }
    write_base(base);
    write_splits(std::move(base.grid));
    return sizes_;
  }

 private:
  void make_header() {
    const Mesh& base = mesh_.mesh();
    const auto is_sharp = [](float sharpness) { return sharpness > 0.0F; };
    const bool is_base_sharp =
        std::any_of(base.sharpnesses().begin(), base.sharpnesses().end(), is_sharp);
    if (is_base_sharp || !mesh_.sharpnesses().empty()) header_.flags |= kPmSharpEdges;
    if (!base.vertex_sharpnesses().empty()) header_.flags |= kPmSharpVertices;
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
    sizes_.base = sizes_.total;
    check_ = header_.base_check;
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
    coder.begin_block(mesh_.level(), end);
    while (mesh_.level() < end) {
      NewSplit split = mesh_.next_split();
      const std::string_view why = coder.code(encoder, mesh_, split);
      if (!why.empty()) refuse(why);
      mesh_.go_to(mesh_.level() + 1);
    }
    const Array<std::byte> payload = encoder.finish(pm_least_bytes(count));
    if (payload.size() > pm_most_bytes(count)) refuse("splits do not fit into a block");
    check_ = pm_block_check(check_, count, payload);
    write(pm_bytes(PmBlockHeader{static_cast<std::uint32_t>(payload.size()), count, check_}));
    write(payload);
  }

  void write(std::span<const std::byte> bytes) {
    sink_(bytes);
    sizes_.total += bytes.size();
  }

  ProgressiveMesh& mesh_;
  const PmWriteOptions& options_;
  const ByteSink& sink_;
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
