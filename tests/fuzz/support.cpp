#include "tests/fuzz/support.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "engine/core/error.h"
#include "engine/io/gltf_model.h"
#include "engine/io/gltf_rewrite.h"
#include "engine/io/gltf_scene.h"
#include "engine/mesh/validate.h"
#include "engine/scene/placed.h"

namespace mesher::test {
namespace {

void expect_one_line(const std::string& message, const std::filesystem::path& file) {
  EXPECT_EQ(message.rfind(file.string(), 0), 0U) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_LT(message.size(), file.string().size() + 200) << message;
}

}  // namespace

Watchdog::Watchdog(std::string what, std::chrono::seconds limit)
    : thread_([this, what = std::move(what), limit] {
        std::unique_lock lock(mutex_);
        if (done_.wait_for(lock, limit, [this] { return is_done_; })) return;
        std::fprintf(stderr, "still busy after %lld s: %s\n", static_cast<long long>(limit.count()),
                     what.c_str());
        std::abort();
      }) {}

Watchdog::~Watchdog() {
  {
    const std::lock_guard lock(mutex_);
    is_done_ = true;
  }
  done_.notify_all();
  thread_.join();
}

std::optional<Model> read_or_refuse(const std::filesystem::path& file, std::string* refusal,
                                    const io::ReadOptions& options) {
  try {
    Model model = io::read_model(file, options);
    for (const Violation& violation : validate(model.mesh)) {
      ADD_FAILURE() << "invariant " << violation.invariant << ": " << violation.what;
    }
    for (const Violation& violation : validate(model.mesh, model.attributes)) {
      ADD_FAILURE() << "invariant " << violation.invariant << ": " << violation.what;
    }
    return model;
  } catch (const InputError& error) {
    const std::string message = error.what();
    expect_one_line(message, file);
    if (refusal != nullptr) *refusal = message;
    return std::nullopt;
  }
}

void edit_scene_or_refuse(const std::filesystem::path& file) {
  const std::filesystem::path output = file.parent_path() / "edited.glb";
  try {
    std::optional<Model> model = read_or_refuse(file, nullptr, {.keeps_scene = true});
    if (!model) return;
    const Shape shown = scene::placed(model->mesh, model->attributes, *model->scene);
    EXPECT_TRUE(validate(shown.mesh).empty());
    EXPECT_TRUE(validate(shown.mesh, shown.attributes).empty());
    const glm::vec3 p = model->mesh.position(Vertex(0));
    model->mesh.set_position(Vertex(0), 0.5F * p);
    io::AtomicFile written(output);
    io::write_gltf_model(written, {model->mesh, model->attributes}, *model->scene, true, nullptr);
    written.commit();
    EXPECT_EQ(io::read_model(output, {.keeps_scene = true}).mesh.face_count(),
              model->mesh.face_count());
  } catch (const InputError& error) {
    expect_one_line(error.what(), file);
  }
  std::filesystem::remove(output);
}

void rewrite_or_refuse(const std::filesystem::path& file) {
  const std::filesystem::path output = file.parent_path() / "rewritten.glb";
  try {
    io::GltfScene scene(file);
    const std::vector<io::GltfSceneMesh> meshes = scene.read_meshes();
    std::vector<io::GltfMeshEdit> edits;
    for (const io::GltfSceneMesh& mesh : meshes)
      edits.push_back({mesh.index, {2, {&mesh.model.mesh, &mesh.model.attributes}}});
    const io::GltfRewriter rewriter(scene.document(), edits);
    io::AtomicFile written(output);
    rewriter.write(written, true);
    written.commit();
    io::GltfScene again(output);
    EXPECT_EQ(again.read_meshes().size(), 2 * meshes.size());
  } catch (const InputError& error) {
    expect_one_line(error.what(), file);
  }
  std::filesystem::remove(output);
}

}  // namespace mesher::test
