#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/io/gltf_file.h"
#include "engine/io/meshopt_view.h"

namespace mesher::io {
namespace {

/// Bytes that sparse accessors and compressed views may take together, and how many more they may
/// take per byte of the file. A sparse accessor may be long and have few values; a file of some
/// bytes could claim billions.
constexpr std::size_t kMostMadeBytes = std::size_t{1} << 26;
constexpr std::size_t kMostMadePerByte = 80;

}  // namespace

/// Refuses files whose accessors and views take much more memory than the file.
void GltfFile::make_room(std::uint64_t count, std::uint64_t element_bytes) {
  const std::uint64_t most = kMostMadeBytes + kMostMadePerByte * byte_count();
  if (count > (most - std::min<std::uint64_t>(most, made_bytes_)) / element_bytes) {
    fail("its sparse or compressed data is too long for the size of the file");
  }
  made_bytes_ += count * element_bytes;
}

/// Returns the bytes of the indices or the values of a sparse accessor.
std::string_view GltfFile::part_bytes(const Json& part, std::size_t element_bytes,
                                      std::uint64_t count) {
  std::size_t stride = element_bytes;
  std::string_view bytes =
      view_bytes(find_number(part, "bufferView").value_or(~std::uint64_t{0}), stride);
  const std::uint64_t offset = find_number(part, "byteOffset").value_or(0);
  if (offset > bytes.size() || count > (bytes.size() - offset) / element_bytes) {
    fail("sparse values extend past their buffer");
  }
  return bytes.substr(offset);
}

/// Returns the bytes of a buffer view, decoded. Sets `stride` if the view has one.
std::string_view GltfFile::view_bytes(std::uint64_t index, std::size_t& stride) {
  const Json& view = element("bufferViews", index);
  stride = static_cast<std::size_t>(find_number(view, "byteStride").value_or(stride));
  if (const Json* compression = extension(view, "EXT_meshopt_compression")) {
    return decoded_view(index, view, *compression);
  }
  return plain_view(index);
}

std::string_view GltfFile::plain_view(std::uint64_t index) {
  const Json& view = element("bufferViews", index);
  return range_of(view);
}

/// Returns the bytes that a buffer view, or the extension of one, refers to.
std::string_view GltfFile::range_of(const Json& view) {
  const std::string_view bytes =
      buffer_bytes(find_number(view, "buffer").value_or(~std::uint64_t{0}));
  const std::uint64_t offset = find_number(view, "byteOffset").value_or(0);
  const std::uint64_t length = find_number(view, "byteLength").value_or(0);
  if (offset > bytes.size() || length > bytes.size() - offset) {
    fail("a buffer view extends past its buffer");
  }
  return bytes.substr(offset, length);
}

/// Returns the decoded bytes of a view with EXT_meshopt_compression.
std::string_view GltfFile::decoded_view(std::uint64_t index, const Json& view,
                                        const Json& compression) {
  const auto known = decoded_views_.find(index);
  if (known != decoded_views_.end()) return known->second;
  const std::string_view bytes = range_of(compression);
  MeshoptView packed{.bytes = bytes,
                     .count = find_number(compression, "count").value_or(0),
                     .stride = find_number(compression, "byteStride").value_or(0),
                     .mode = text(compression, "mode"),
                     .filter = text(compression, "filter")};
  const std::uint64_t length = find_number(view, "byteLength").value_or(0);
  const std::string problem = objection(packed, length);
  if (!problem.empty()) fail(problem);
  make_room(packed.count, packed.stride);
  std::string decoded;
  if (!decode_meshopt(packed, decoded)) fail("a view's EXT_meshopt_compression data is damaged");
  return decoded_views_.emplace(index, std::move(decoded)).first->second;
}

const GltfFile::Json* GltfFile::extension(const Json& object, const char* name) const {
  const auto extensions = object.find("extensions");
  if (extensions == object.end() || !extensions->is_object()) return nullptr;
  const auto found = extensions->find(name);
  return found == extensions->end() || !found->is_object() ? nullptr : &*found;
}

std::filesystem::path GltfFile::folder() const {
  return std::filesystem::path(file_.name()).parent_path();
}

double GltfFile::full_value(std::uint64_t index) const {
  const Json& json = element("accessors", index);
  const auto normalized = json.find("normalized");
  if (normalized == json.end() || *normalized != true) return 0.0;
  switch (find_number(json, "componentType").value_or(0)) {
    case 5120:
      return 127.0;
    case 5121:
      return 255.0;
    case 5122:
      return 32767.0;
    case 5123:
      return 65535.0;
    default:
      return 0.0;
  }
}

}  // namespace mesher::io
