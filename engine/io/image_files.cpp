#include "engine/io/image_files.h"

#include <memory>
#include <optional>
#include <system_error>

#include "engine/core/error.h"
#include "engine/io/mapped_file.h"

namespace mesher::io {

std::string_view image_type(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1A\n")) return "image/png";
  if (bytes.starts_with("\xFF\xD8\xFF")) return "image/jpeg";
  if (bytes.starts_with("RIFF") && bytes.size() >= 12 && bytes.substr(8, 4) == "WEBP")
    return "image/webp";
  if (bytes.starts_with("\xABKTX 20\xBB\r\n\x1A\n")) return "image/ktx2";
  if (bytes.starts_with("DDS ")) return "image/vnd-ms.dds";
  return {};
}

void ImageFiles::load(EncodedImage& image, const Beside& found, std::string_view text) {
  const auto warn = [&](std::string_view reason) {
    contents_.warn("texture " + std::string(text) + ": " + std::string(reason));
  };
  if (found.file.empty()) return warn(found.reason());
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(found.file, error);
  if (error) return warn(error.message());
  if (size > kMostImageBytes || size > kMostBytesOfImages - bytes_) return warn("too large");
  std::optional<MappedFile> file;
  try {
    file.emplace(found.file);
  } catch (const InputChanged&) {
    throw;
  } catch (const InputError& failure) {
    return warn(failure.reason());
  }
  image.bytes = std::make_shared<const std::string>(file->bytes());
  file->check_unchanged();
  image.mime_type = image_type(*image.bytes);
  bytes_ += image.bytes->size();
}

}  // namespace mesher::io
