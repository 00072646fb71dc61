#include <new>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/io/format.h"
#include "engine/io/read.h"

namespace mesher::io {
namespace {

/// Time of building a mesh, in the unit of FormatInfo::read_weight.
constexpr double kBuildWeight = 1.0;

}  // namespace

Model read_model(const std::filesystem::path& file, const ReadOptions& options) {
  const FormatInfo* format = format_of(file);
  try {
    if (options.keeps_scene && format != nullptr && format->read_scene != nullptr)
      return format->read_scene(file, options);
    Stages stages(options.progress, {format == nullptr ? 1.0 : format->read_weight, kBuildWeight});
    stages.next();
    Soup soup = read_soup(file, options);
    FileContents contents = std::move(soup.contents);
    const std::shared_ptr<const Materials> materials = soup.materials;
    const glm::dvec3 origin = soup.origin;
    stages.next();
    BuildResult built = build_mesh(
        std::move(soup),
        {.keep_isolated_vertices = options.keep_isolated_vertices, .progress = options.progress});
    return {.name = file.filename().string(),
            .mesh = std::move(built.mesh),
            .attributes = std::move(built.attributes),
            .materials = materials,
            .report = built.report,
            .contents = std::move(contents),
            .origin = origin};
  } catch (const InputError& error) {
    if (!error.file().empty()) throw;
    throw InputError(file.string(), error.line(), error.reason());
  } catch (const std::bad_alloc&) {
    throw_out_of_memory(file.string());
  }
}

}  // namespace mesher::io
