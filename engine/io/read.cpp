#include "engine/io/read.h"

#include <new>
#include <stdexcept>
#include <string>

#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/io/format.h"
#include "engine/io/join.h"
#include "engine/io/mapped_file.h"

namespace mesher::io {
namespace {

Soup read_polygons(const FormatInfo& format, const std::filesystem::path& file,
                   const ReadOptions& options) {
  const MappedFile bytes(file, options.progress);
  if (bytes.size() == 0) throw InputError(bytes.name(), 0, "is empty");
  Stages stages(options.progress, {1.0 - format.join_part, format.join_part});
  stages.next();
  Soup soup = read_unchanged(bytes, [&] { return format.read(bytes, options); });
  stages.next("connecting");
  if (options.weld && !format.joins_itself) join_vertices(soup, *options.weld, options.progress);
  return soup;
}

}  // namespace

Soup read_soup(const std::filesystem::path& file, const ReadOptions& options) {
  const std::string name = file.string();
  const FormatInfo* format = format_of(file);
  if (format == nullptr) {
    throw InputError(name, 0, "unknown extension; mesher opens " + readable_formats());
  }
  if (format->read == nullptr) {
    throw InputError(name, 0, std::string("holds a ") + format->name + ", not polygons");
  }
  if (options.pose && !format->has_animations) throw InputError(name, 0, "has no animations");
  begin_stage(options.progress, "reading");
  try {
    return read_polygons(*format, file, options);
  } catch (const InputError& error) {
    if (!error.file().empty()) throw;
    throw InputError(name, error.line(), error.reason());
  } catch (const std::bad_alloc&) {
    throw_out_of_memory(name);
  } catch (const std::length_error&) {
    throw_out_of_memory(name);
  }
}

}  // namespace mesher::io
