#include <mesher/error.h>
#include <mesher/progressive_mesh.h>

#include "engine/io/atomic_file.h"
#include "engine/io/pm_file.h"
#include "engine/library/asset_data.h"
#include "engine/library/simplify_rules.h"
#include "engine/library/watch.h"
#include "engine/mesh/statistics.h"
#include "engine/progressive/base.h"
#include "engine/progressive/build.h"
#include "engine/simplify/seams.h"

namespace mesher {

struct ProgressiveMesh::Data {
  progressive::ProgressiveMesh mesh;
  progressive::ProgressiveAttributes attributes;  ///< at the level of the mesh
  Asset model;
  std::string damage;

  void go_to(std::uint32_t level) {
    mesh.go_to(level);
    if (!attributes.is_empty()) attributes.go_to(level);
  }
};

namespace {

std::vector<ElementRange> face_ranges(const ChangeLog& changes, GpuArray array,
                                      std::uint32_t count) {
  if (changes.is_whole(array)) return {{0, count}};
  std::vector<ElementRange> ranges;
  for (const ChangedRange& range : changes.merged(array, 0, count))
    ranges.push_back({range.begin, range.end});
  return ranges;
}

simplify::SimplifyOptions base_options(const Model& model, const ProgressiveOptions& options) {
  simplify::SimplifyOptions engine = engine_rules(options);
  engine.target_faces = options.base_faces;
  if (options.base_faces == 0)
    progressive::choose_base(engine, model.mesh.face_count(), bounding_box(model.mesh).diagonal(),
                             simplify::may_have_lines(model.attributes));
  return engine;
}

}  // namespace

ProgressiveMesh::ProgressiveMesh(std::unique_ptr<Data> data) : data_(std::move(data)) {
  data_->mesh.mesh().changes().note_all();
}
ProgressiveMesh::ProgressiveMesh(ProgressiveMesh&&) noexcept = default;
ProgressiveMesh& ProgressiveMesh::operator=(ProgressiveMesh&&) noexcept = default;
ProgressiveMesh::~ProgressiveMesh() = default;

ProgressiveMesh::ProgressiveMesh(const Asset& model, const ProgressiveOptions& options)
    : data_(std::make_unique<Data>()) {
  const Mesh& full = model.data_->model.mesh;
  if (full.face_count() == 0) throw InputError("progressive mesh: the model has no faces");
  Watch watch(options.progress);
  simplify::SimplifyOptions engine = base_options(model.data_->model, options);
  engine.progress = watch.progress();
  progressive::Progressive made =
      progressive::make_progressive(full, model.data_->model.attributes, engine);
  data_->mesh = std::move(made.mesh);
  data_->attributes = std::move(made.attributes);
  data_->go_to(data_->mesh.split_count());
  data_->mesh.mesh().changes().note_all();
  data_->model = model;
}

ProgressiveMesh ProgressiveMesh::load(const std::filesystem::path& file,
                                      const ProgressCallback& progress) {
  Watch watch(progress);
  io::PmContents contents = io::read_pm_file(file, watch.progress());
  auto data = std::make_unique<Data>();
  data->mesh = std::move(contents.mesh);
  data->attributes = std::move(contents.attributes);
  auto asset = std::make_shared<Asset::Data>();
  asset->model.materials = std::move(contents.materials);
  asset->model.contents = std::move(contents.contents);
  data->model = Asset(std::move(asset));
  data->damage = contents.summary.damage;
  return ProgressiveMesh(std::move(data));
}

void ProgressiveMesh::save(const std::filesystem::path& file, unsigned coordinate_bits,
                           const ProgressCallback& progress) {
  if (coordinate_bits != 0 && (coordinate_bits < 4 || coordinate_bits > 24))
    throw UsageError("progressive mesh: the number of bits is neither 0 nor 4 to 24");
  Watch watch(progress);
  io::AtomicFile out(file);
  io::write_pm_file(out, data_->mesh,
                    {.coordinate_bits = coordinate_bits,
                     .attributes = &data_->attributes,
                     .progress = watch.progress()},
                    data_->model.data_->model.materials.get());
  seal(watch.progress());
  out.commit(io::Flush::now);
}

std::uint32_t ProgressiveMesh::level() const {
  return data_->mesh.level();
}

std::uint32_t ProgressiveMesh::level_count() const {
  return data_->mesh.split_count();
}

std::uint32_t ProgressiveMesh::face_count(std::uint32_t level) const {
  return data_->mesh.face_count(level);
}

void ProgressiveMesh::set_level(std::uint32_t level) {
  data_->go_to(level);
}

void ProgressiveMesh::set_face_count(std::uint32_t faces) {
  data_->go_to(data_->mesh.level_for_faces(faces));
}

bool ProgressiveMesh::refine() {
  if (level() == level_count()) return false;
  data_->go_to(level() + 1);
  return true;
}

bool ProgressiveMesh::coarsen() {
  if (level() == 0) return false;
  data_->go_to(level() - 1);
  return true;
}

std::span<const std::array<float, 3>> ProgressiveMesh::positions() const {
  return face_positions(data_->mesh.mesh());
}

std::span<const std::uint32_t> ProgressiveMesh::indices() const {
  return face_ids(data_->mesh.mesh().origins());
}

ChangedRanges ProgressiveMesh::take_changes() {
  Mesh& mesh = data_->mesh.mesh();
  ChangedRanges ranges{
      .positions = face_ranges(mesh.changes(), GpuArray::position, mesh.vertex_count()),
      .indices = face_ranges(mesh.changes(), GpuArray::origin, mesh.halfedge_count())};
  mesh.changes().clear();
  return ranges;
}

Asset ProgressiveMesh::current() const {
  const Mesh& mesh = data_->mesh.mesh();
  const Model& model = data_->model.data_->model;
  auto result = std::make_shared<Asset::Data>();
  result->model.mesh = mesh;
  result->model.mesh.changes().clear();
  result->model.origin = model.origin;
  result->model.materials = model.materials;
  if (!data_->attributes.is_empty()) {
    result->model.attributes = data_->attributes.at_level(mesh);
  }
  return Asset(std::move(result));
}

const std::string& ProgressiveMesh::damage() const {
  return data_->damage;
}

}  // namespace mesher
