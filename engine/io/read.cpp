#include "engine/io/read.h"

#include <new>
#include <stdexcept>
#include <string>

#include "engine/core/error.h"
#include "engine/io/format.h"
#include "engine/io/gltf_read.h"
#include "engine/io/mapped_file.h"
#include "engine/io/obj_read.h"
#include "engine/io/off_read.h"
#include "engine/io/ply_read.h"
#include "engine/io/stl_read.h"

namespace mesher {
namespace {

Soup read_format(Format format, const std::filesystem::path& file, const ReadOptions& options) {
  const MappedFile bytes(file, options.progress);
  if (bytes.size() == 0) throw InputError(bytes.name(), 0, "is empty");
  switch (format) {
    case Format::obj:
      return read_obj(bytes, options);
    case Format::ply:
      return read_ply(bytes);
    case Format::stl:
      return read_stl(bytes);
    case Format::off:
      return read_off(bytes);
    default:
      return read_gltf(bytes);
  }
}

}  // namespace

Soup read_soup(const std::filesystem::path& file, const ReadOptions& options) {
  const std::string name = file.string();
  const std::optional<Format> format = format_of(file);
  if (!format) {
    throw InputError(name, 0, "unknown kind of file; known are " + std::string(kFormatNames));
  }
  begin_stage(options.progress, "reading " + file.filename().string());
  try {
    return read_format(*format, file, options);
  } catch (const std::bad_alloc&) {
    throw DeviceError(name + ": not enough memory");
  } catch (const std::length_error&) {
    throw DeviceError(name + ": not enough memory");
  }
}

}  // namespace mesher
