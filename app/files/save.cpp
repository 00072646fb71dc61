#include "app/files/save.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "app/document/document.h"
#include "app/document/preferences.h"
#include "app/document/saving.h"
#include "app/document/shown.h"
#include "app/edit/progressive_edits.h"
#include "app/files/browse.h"
#include "app/files/paths.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/format.h"
#include "engine/io/losses.h"
#include "engine/io/pm_file.h"
#include "engine/io/write.h"
#include "engine/progressive/build.h"
#include "engine/scene/placed.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

/// Times of building the progressive mesh, unless there is one, and of writing it: 0.1, 1.4 and 13
/// million faces.
constexpr double kMakeLevelsWeights[] = {0.56, 0.44};
constexpr double kWriteLevelsWeights[] = {0.0, 1.0};

bool is_writable(const fs::path& file) {
  const io::FormatInfo* format = io::format_of(file);
  return (format != nullptr && format->write != nullptr) || io::has_pm_ending(file);
}

bool has_creases(const Model& model, const Statistics& statistics) {
  return statistics.crease_edges > 0 || !model.mesh.vertex_sharpnesses().empty();
}

/// Returns why the requested file cannot be written; empty if it can.
std::string objection(Saving& saving, const Document& document, const fs::path& file) {
  if (document.statistics.faces == 0) return "there is nothing to save";
  if (file.empty()) return "enter a file name";
  if (!is_writable(file)) return "the name must end in " + io::readable_formats();
  if (!is_there(file.parent_path())) return "there is no folder " + file.parent_path().string();
  if (document.progressive.is_arriving())
    return "the file is still loading; press Esc to stop loading";
  return overwrite_question(saving.asked, file);
}

/// The format of the last saved file, if it can hold the creases.
std::string extension_for(const Document& document, const Preferences& preferences) {
  const fs::path last = "x" + preferences.save_extension;
  const io::FormatInfo* format = io::format_of(last);
  const bool fits = format != nullptr && is_writable(last) &&
                    (format->holds.creases || !has_creases(document.model, document.statistics));
  return fits ? format->extension : suggested_file(document).extension().string();
}

/// The shown level, or the model that its progressive mesh is made of.
Shape written_shape(const Document& document, const fs::path& file) {
  if (io::has_pm_ending(file)) return {document.model.mesh, document.model.attributes};
  return shown_shape(document);
}

/// Returns whether a file can hold the scene that a model comes from.
bool keeps_scene(const scene::Scene* scene, const fs::path& file) {
  const io::FormatInfo* format = io::format_of(file);
  return scene != nullptr && scene->source != nullptr && format != nullptr &&
         format->write_scene != nullptr;
}

/// Returns what the scene shows of a model, for files that hold no scenes.
Shape shown_by_scene(Shape&& shape, const scene::Scene* scene) {
  if (scene == nullptr || !scene::differs_from_model(*scene)) return std::move(shape);
  return scene::placed(shape.mesh, shape.attributes, *scene);
}

std::vector<std::string> losses_of(const SaveTask& task, const Shape& shape) {
  return io::losses_in_format(task.file, shape.mesh, shape.attributes, task.materials.get(),
                              task.contents, task.origin);
}

/// Returns "creases" if a format holds none of those of a mesh. O(F).
std::vector<std::string> creases_lost_by(const fs::path& file, const Mesh& mesh) {
  const bool has_any = std::ranges::any_of(mesh.sharpnesses(), [](float s) { return s > 0.0F; }) ||
                       !mesh.vertex_sharpnesses().empty();
  if (!has_any || io::format_of(file)->holds.creases) return {};
  return {"creases"};
}

std::vector<std::string> write_scene(const SaveTask& task, Progress* progress) {
  io::AtomicFile file(task.file);
  std::vector<std::string> losses = creases_lost_by(task.file, task.shape->mesh);
  std::ranges::move(io::format_of(task.file)->write_scene(file, *task.shape, *task.scene, progress),
                    std::back_inserter(losses));
  seal(progress);
  file.commit(task.flush);
  return losses;
}

void write_progressive(const SaveTask& task, Progress* progress) {
  std::shared_ptr<progressive::ProgressiveMesh> levels = task.levels;
  std::shared_ptr<progressive::ProgressiveAttributes> attributes = task.attributes;
  Stages stages(progress, levels ? kWriteLevelsWeights : kMakeLevelsWeights);
  stages.next();
  if (!levels) {
    simplify::SimplifyOptions rules = task.rules;
    rules.progress = progress;
    progressive::Progressive made =
        progressive::make_progressive(task.shape->mesh, task.shape->attributes, rules);
    levels = std::make_shared<progressive::ProgressiveMesh>(std::move(made.mesh));
    attributes = std::make_shared<progressive::ProgressiveAttributes>(std::move(made.attributes));
  }
  stages.next();
  io::AtomicFile file(task.file);
  io::write_pm_file(file, *levels, {.attributes = attributes.get(), .progress = progress},
                    task.materials.get());
  seal(progress);
  file.commit(task.flush);
}

}  // namespace

fs::path suggested_file(const Document& document) {
  const std::string own = document.file.extension().string();
  const bool keeps_own = is_writable(document.file) && !io::has_pm_ending(document.file) &&
                         !has_creases(document.model, document.statistics);
  return free_name(document.file.parent_path(), document.file.stem().string() + "-edited",
                   keeps_own ? own : ".obj");
}

void open_save_dialog(Saving& saving, const Document& document, const Preferences& preferences) {
  const fs::path suggested = suggested_file(document);
  // The samples belong to the program.
  const bool is_sample = suggested.parent_path() == samples_folder();
  const fs::path own = is_sample ? fs::path(".") : nearest_folder(suggested.parent_path());
  const fs::path folder = is_folder(preferences.save_folder) ? preferences.save_folder : own;
  const FolderFilter filter = saving.browser.filter;
  saving = {
      .shows_dialog = true, .browser = {}, .asked = {}, .then = {}, .waiting = saving.waiting};
  saving.browser.filter = filter;
  saving.browser.filter.shows_hidden = preferences.shows_hidden_files;
  go_to(saving.browser, folder);
  const fs::path name = free_name(saving.browser.folder, document.file.stem().string() + "-edited",
                                  extension_for(document, preferences))
                            .filename();
  set_text(saving.browser, name.string());
}

std::vector<std::string> saved_extensions() {
  std::vector<std::string> extensions;
  for (const io::FormatInfo& format : io::formats()) {
    if (is_writable(std::string("x") + format.extension)) extensions.emplace_back(format.extension);
  }
  return extensions;
}

fs::path with_format(fs::path file, const fs::path& suggested) {
  if (!is_writable(file)) file += suggested.extension();
  return file;
}

void choose_format(Saving& saving, const std::string& extension) {
  fs::path typed = typed_path(saving.browser.typed);
  if (!typed.has_filename()) return;
  // A dot in a name need not begin an extension: "scan 2.1".
  if (is_writable(typed)) typed.replace_extension();
  set_text(saving.browser, typed.string() + extension);
}

std::vector<std::string> always_lost(const Document& document, const std::string& extension) {
  const io::FormatInfo* format = io::format_of("x" + extension);
  if (format == nullptr) return {};
  const Attributes& attributes = document.model.attributes;
  std::vector<std::string> lost;
  const auto add = [&](bool is_there, bool is_held, const char* name) {
    if (is_there && !is_held) lost.emplace_back(name);
  };
  const io::FormatContents& holds = format->holds;
  add(has_creases(document.model, document.statistics), holds.creases, "creases");
  if (keeps_scene(document.model.scene.get(), "x" + extension)) return lost;
  const auto has = [&](AttributeKind kind) { return attributes.find(kind) != nullptr; };
  add(has(AttributeKind::texcoord), holds.texcoord != io::Holds::nothing, "texture coordinates");
  add(has(AttributeKind::normal), holds.normal != io::Holds::nothing, "normals");
  add(has(AttributeKind::color), holds.color != io::Holds::nothing, "colors");
  const auto has_name = [](const FaceGroup& group) {
    return !group.object.empty() || !group.name.empty() || !group.smoothing.empty();
  };
  add(std::ranges::any_of(attributes.groups, has_name), holds.groups, "groups");
  add(document.model.contents[Content::materials] > 0, io::holds_look(holds.materials),
      "materials");
  add(document.model.contents[Content::textures] > 0,
      holds.materials != io::HoldsMaterials::nothing, "textures");
  return lost;
}

std::vector<std::string> losses_of(const Document& document, const fs::path& file) {
  if (keeps_scene(document.model.scene.get(), file))
    return creases_lost_by(file, shown_mesh(document));
  const auto [mesh, attributes] =
      shown_by_scene(written_shape(document, file), document.model.scene.get());
  return io::losses_in_format(file, mesh, attributes, document.model.materials.get(),
                              document.model.contents, document.model.origin);
}

void submit_save(Saving& saving, const Document& document,
                 const std::vector<const FolderEntry*>& shown) {
  FileBrowser& browser = saving.browser;
  if (take_row(browser, shown)) return;
  const fs::path file = typed_file(browser);
  if (is_folder(file)) return go_to(browser, file);
  const std::string problem = objection(saving, document, file);
  if (!problem.empty()) return refuse_text(browser, problem);
  saving.waiting = file;
  saving.shows_dialog = false;
  saving.asked.clear();
}

std::optional<SaveTask> begin_save(Saving& saving, const Document& document) {
  if (!saving.waiting) return std::nullopt;
  const bool is_pm = io::has_pm_ending(*saving.waiting);
  SaveTask task{.file = *saving.waiting,
                .shape = std::make_shared<const Shape>(written_shape(document, *saving.waiting)),
                .materials = document.model.materials,
                .scene = document.model.scene,
                .contents = document.model.contents,
                .origin = document.model.origin,
                .levels = nullptr,
                .attributes = nullptr,
                .rules = {},
                .opening = document.opening,
                .state = std::nullopt,
                .then = std::exchange(saving.then, std::nullopt)};
  if (is_pm && document.progressive.has_mesh()) {
    task.levels = std::make_shared<progressive::ProgressiveMesh>(document.progressive.mesh());
    task.attributes = std::make_shared<progressive::ProgressiveAttributes>(
        document.progressive.levels().attributes);
  } else if (is_pm) {
    task.rules = progressive_options(document);
  }
  if (is_pm || !document.progressive.is_on()) task.state = document.edits.history.state();
  saving.waiting.reset();
  return task;
}

Saved perform(const SaveTask& task, Progress* progress) {
  Saved saved{.file = task.file,
              .vertices = task.shape->mesh.vertex_count(),
              .faces = task.shape->mesh.face_count(),
              .losses = {},
              .opening = task.opening,
              .state = task.state,
              .then = task.then};
  if (io::has_pm_ending(task.file)) {
    write_progressive(task, progress);
    saved.losses = losses_of(task, *task.shape);
    if (task.scene && scene::differs_from_model(*task.scene))
      saved.losses.emplace_back("places and poses of the scene's meshes");
  } else if (keeps_scene(task.scene.get(), task.file)) {
    saved.losses = write_scene(task, progress);
  } else {
    const Shape shape = shown_by_scene(Shape(*task.shape), task.scene.get());
    if (shape.mesh.face_count() == 0)
      throw OutputError(task.file.string(), "there is nothing to save: the scene shows no faces");
    saved.vertices = shape.mesh.vertex_count();
    saved.faces = shape.mesh.face_count();
    io::write_model(task.file, shape.mesh, shape.attributes,
                    {.origin = task.origin,
                     .materials = task.materials,
                     .progress = progress,
                     .flush = task.flush});
    saved.losses = losses_of(task, shape);
  }
  return saved;
}

std::string notice_of(const Saved& saved) {
  std::string notice =
      fmt::format("saved {}: {}", saved.file.string(), count_text(saved.faces, "face"));
  for (std::size_t i = 0; i < saved.losses.size(); ++i)
    notice += (i == 0 ? "; it does not hold " : ", ") + saved.losses[i];
  return notice;
}

}  // namespace mesher::app
