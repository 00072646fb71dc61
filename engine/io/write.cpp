#include "engine/io/write.h"

#include <optional>
#include <string>

#include "engine/core/error.h"
#include "engine/io/gltf_write.h"
#include "engine/io/obj_write.h"
#include "engine/io/polygon_write.h"

namespace mesher {

void write_model(const std::filesystem::path& file, const Mesh& mesh, const Attributes& attributes,
                 const WriteOptions& options) {
  const std::optional<Format> format = format_of(file);
  if (!format) {
    throw UsageError(file.string() + ": unknown kind of file; known are " +
                     std::string(kFormatNames));
  }
  AtomicFile out(file);
  write_model(out, *format, mesh, attributes, options);
  out.commit();
}

void write_model(AtomicFile& out, Format format, const Mesh& mesh, const Attributes& attributes,
                 const WriteOptions& options) {
  switch (format) {
    case Format::obj:
      return write_obj(out, mesh, attributes);
    case Format::ply:
      return write_ply(out, mesh, attributes, options.ascii);
    case Format::stl:
      return write_stl(out, mesh, options.ascii);
    case Format::off:
      return write_off(out, mesh, attributes);
    default:
      return write_gltf(out, mesh, attributes, format == Format::glb);
  }
}

}  // namespace mesher
