#include <new>
#include <utility>

#include "engine/core/error.h"
#include "engine/io/read.h"

namespace mesher::io {

Model read_model(const std::filesystem::path& file, const ReadOptions& options) {
  Soup soup = read_soup(file, options);
  try {
    BuildResult built = build_mesh(
        std::move(soup),
        {.keep_isolated_vertices = options.keep_isolated_vertices, .progress = options.progress});
    return {.name = file.filename().string(),
            .mesh = std::move(built.mesh),
            .attributes = std::move(built.attributes),
            .report = built.report};
  } catch (const InputError& error) {
    if (!error.file().empty()) throw;
    throw InputError(file.string(), error.line(), error.reason());
  } catch (const std::bad_alloc&) {
    throw DeviceError(file.string() + ": out of memory");
  }
}

}  // namespace mesher::io
