#include "app/cli/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <string_view>

#include "app/cli/batch.h"
#include "app/cli/progress_line.h"
#include "app/files/paths.h"
#include "engine/core/error.h"
#include "engine/core/face_limit.h"
#include "engine/core/text.h"
#include "engine/io/atomic_file.h"
#include "engine/io/format.h"
#include "engine/mesh/creases.h"

namespace mesher::app {
namespace {

/// Times of reading the document, and of building its meshes.
constexpr double kSceneWeights[] = {0.2, 0.8};
/// Times of arranging a file, and of writing it.
constexpr double kWriteSceneWeights[] = {0.4, 0.6};

bool is_gltf(const std::filesystem::path& file) {
  const io::FormatInfo* format = io::format_of(file);
  return format != nullptr && format->write_levels != nullptr;
}

/// Building a mesh does not know the file, so its errors get the name here.
void read_meshes(LoadedScene& loaded, const io::ReadOptions& options) {
  try {
    loaded.meshes = loaded.scene->read_meshes(options);
    for (const io::GltfSceneMesh& mesh : loaded.meshes)
      loaded.shows_any |= mesh.placements > 0;
    FaceLimit::check(loaded.face_count());
  } catch (const InputError& error) {
    if (!error.file().empty()) throw;
    throw InputError(loaded.file.string(), error.line(), error.reason());
  }
}

/// Makes each mesh one that is written anew.
void replace_all(std::vector<io::GltfMeshEdit>& edits, const LoadedScene& scene) {
  for (const io::GltfSceneMesh& mesh : scene.meshes) {
    const auto edit = std::ranges::find(edits, mesh.index, &io::GltfMeshEdit::mesh);
    if (edit == edits.end())
      edits.push_back(edit_of(mesh));
    else
      edit->replaces = true;
  }
}

}  // namespace

std::uint64_t LoadedScene::face_count() const {
  std::uint64_t faces = 0;
  for (const io::GltfSceneMesh& mesh : meshes)
    faces += weight(mesh) * mesh.model.mesh.face_count();
  return faces;
}

std::uint64_t LoadedScene::vertex_count() const {
  std::uint64_t vertices = 0;
  for (const io::GltfSceneMesh& mesh : meshes)
    vertices += weight(mesh) * mesh.model.mesh.vertex_count();
  return vertices;
}

bool keeps_scene(const InputOptions& input, const std::string& output,
                 const CommonOptions& common) {
  if (common.compresses && !is_gltf(output))
    throw UsageError("--compress: only .gltf and .glb can be compressed, not '" + output + "'");
  return is_gltf(output) && is_gltf(find_model(input.model));
}

LoadedScene load_scene(const InputOptions& input, const CommonOptions& common) {
  LoadedScene loaded;
  loaded.file = find_model(input.model);
  {
    ProgressLine line(!common.quiet, loaded.file.filename().string());
    Stages stages(line.progress(), kSceneWeights);
    io::ReadOptions options = read_options(input);
    options.progress = line.progress();
    stages.next("reading");
    loaded.scene = std::make_unique<io::GltfScene>(loaded.file, options);
    stages.next();
    read_meshes(loaded, options);
  }
  for (io::GltfSceneMesh& mesh : loaded.meshes) {
    loaded.report += mesh.model.report;
    if (input.tag_creases_deg)
      tag_creases_by_angle(mesh.model.mesh, glm::radians(*input.tag_creases_deg));
  }
  loaded.diagonal = loaded.scene->bounds(loaded.meshes).diagonal();
  if (!common.quiet) say_repairs(loaded.report);
  return loaded;
}

LoadedScene load_scene_with_faces(const InputOptions& input, const CommonOptions& common,
                                  const char* what) {
  LoadedScene loaded = load_scene(input, common);
  if (loaded.meshes.empty())
    throw InputError(loaded.file.string(), 0, std::string("has no faces to ") + what);
  return loaded;
}

std::vector<simplify::SceneShape> shapes_of(const LoadedScene& scene) {
  std::vector<simplify::SceneShape> shapes;
  for (const io::GltfSceneMesh& mesh : scene.meshes)
    shapes.push_back({mesh.model.mesh, mesh.model.attributes, scene.weight(mesh), mesh.scale});
  return shapes;
}

std::uint64_t scene_faces_for(double ratio, const LoadedScene& scene) {
  return std::max<std::uint64_t>(
      1, static_cast<std::uint64_t>(std::llround(ratio * double(scene.face_count()))));
}

io::GltfMeshEdit edit_of(const io::GltfSceneMesh& mesh) {
  return {.mesh = mesh.index, .levels = {{&mesh.model.mesh, &mesh.model.attributes}}};
}

std::vector<std::string> write_scene(io::AtomicFile& file, LoadedScene& scene,
                                     std::vector<io::GltfMeshEdit> edits,
                                     const CommonOptions& common) {
  if (common.compresses) replace_all(edits, scene);
  const std::filesystem::path target = file.name();
  ProgressLine line(!common.quiet, target.filename().string());
  Stages stages(line.progress(), kWriteSceneWeights);
  stages.next("writing");
  const io::GltfRewriter rewriter(scene.scene->document(), edits, common.compresses,
                                  line.progress());
  stages.next();
  rewriter.write(file, std::string_view(io::format_of(target)->extension) == ".glb",
                 line.progress());
  return rewriter.losses();
}

std::vector<std::string> write_scene(const std::string& output, LoadedScene& scene,
                                     std::vector<io::GltfMeshEdit> edits,
                                     const CommonOptions& common) {
  io::AtomicFile file(output);
  const std::vector<std::string> losses = write_scene(file, scene, std::move(edits), common);
  file.commit(common.flush());
  if (!common.quiet) say_losses(output, losses);
  return losses;
}

void say_scene(const std::string& output, const LoadedScene& scene) {
  const auto number = [](std::uint64_t count) { return static_cast<std::int64_t>(count); };
  say(fmt::format("{}: {} vertices, {} in {}", output, count_text(number(scene.vertex_count())),
                  count_text(number(scene.face_count()), "face"),
                  count_phrase(number(scene.meshes.size()), "{mesh|meshes}")));
}

std::string name_of(const io::GltfSceneMesh& mesh) {
  return mesh.model.name.empty() ? fmt::format("mesh {}", mesh.index) : mesh.model.name;
}

}  // namespace mesher::app
