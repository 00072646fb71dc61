#include "engine/io/write.h"

#include <optional>
#include <string>

#include "engine/core/error.h"
#include "engine/io/atomic_file.h"
#include "engine/io/format.h"
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
  switch (*format) {
    case Format::obj:
      write_obj(out, mesh, attributes);
      break;
    case Format::ply:
      write_ply(out, mesh, attributes, options.ascii);
      break;
    case Format::stl:
      write_stl(out, mesh, options.ascii);
      break;
    case Format::off:
      write_off(out, mesh, attributes);
      break;
    default:
      write_gltf(out, mesh, attributes, *format == Format::glb);
  }
  out.commit();
}

}  // namespace mesher
