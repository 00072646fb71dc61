#include "engine/io/write.h"

#include "engine/core/error.h"
#include "engine/io/format.h"

namespace mesher::io {

const FormatInfo& writable_format(const std::filesystem::path& file) {
  const FormatInfo* format = format_of(file);
  if (format == nullptr) {
    throw UsageError(file.string() + ": unknown extension; mesher writes " + writable_formats());
  }
  if (format->write == nullptr) {
    throw UsageError(file.string() + ": use `mesher progressive` to write a progressive mesh");
  }
  return *format;
}

void write_model(const std::filesystem::path& file, const Mesh& mesh, const Attributes& attributes,
                 const WriteOptions& options) {
  const FormatInfo& format = writable_format(file);
  Stages stages(options.progress, {1.0});
  stages.next("writing");
  AtomicFile out(file);
  WriteOptions written = options;
  if (held_materials(format, file) == HoldsMaterials::nothing) written.materials = nullptr;
  format.write(out, mesh, attributes, written);
  seal(options.progress);
  out.commit(options.flush);
}

}  // namespace mesher::io
