#include "engine/io/write.h"

#include <optional>
#include <string>

#include "engine/core/error.h"
#include "engine/io/atomic_file.h"
#include "engine/io/format.h"
#include "engine/io/obj_write.h"

namespace mesher {

void write_model(const std::filesystem::path& file, const Mesh& mesh, const Attributes& attributes,
                 const WriteOptions&) {
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
    default:
      throw OutputError(file.string(), "cannot be written yet");
  }
  out.commit();
}

}  // namespace mesher
