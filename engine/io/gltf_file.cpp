#include "engine/io/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/io/base64.h"
#include "engine/io/beside.h"
#include "engine/io/gltf_types.h"
#include "engine/io/text_cursor.h"
#include "engine/mesh/contents.h"

namespace mesher::io {
namespace {

constexpr std::string_view kMagic = "glTF";
constexpr std::uint32_t kJsonChunk = 0x4E4F534AU;
constexpr std::uint32_t kBinaryChunk = 0x004E4942U;

std::uint32_t load_uint32(const char* p) {
  std::uint32_t value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

constexpr std::size_t kElementsBetweenReports = std::size_t{1} << 16;

/// Iterates over the characters of a text, and reports how far it has come.
class JsonText {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  JsonText(const char* p, const char* begin, const char* end, Progress* progress)
      : p_(p), begin_(begin), end_(end), stop_(p), progress_(progress) {}

  reference operator*() const { return *p_; }
  JsonText& operator++() {
    if (p_++ == stop_) note();
    return *this;
  }
  friend bool operator==(const JsonText& a, const JsonText& b) { return a.p_ == b.p_; }

 private:
  void note() {
    constexpr std::ptrdiff_t kBetweenReports = std::ptrdiff_t{1} << 18;
    stop_ = p_ + std::min(kBetweenReports, end_ - p_);
    report(progress_, static_cast<float>(static_cast<double>(p_ - begin_) /
                                         static_cast<double>(end_ - begin_)));
  }

  const char* p_;
  const char* begin_;
  const char* end_;
  const char* stop_;  ///< where the next report is due
  Progress* progress_;
};

template <class T>
float load_as_float(const char* p, float full) {
  T value;
  std::memcpy(&value, p, sizeof value);
  const float fraction = static_cast<float>(value) / full;
  return full == 1.0F ? fraction : std::max(fraction, -1.0F);
}

float load_float(const char* p, ComponentType type, bool is_normalized) {
  const auto full = [&](float largest) { return is_normalized ? largest : 1.0F; };
  switch (type) {
    case ComponentType::s8:
      return load_as_float<std::int8_t>(p, full(127.0F));
    case ComponentType::u8:
      return load_as_float<std::uint8_t>(p, full(255.0F));
    case ComponentType::s16:
      return load_as_float<std::int16_t>(p, full(32767.0F));
    case ComponentType::u16:
      return load_as_float<std::uint16_t>(p, full(65535.0F));
    case ComponentType::u32:
      return load_as_float<std::uint32_t>(p, full(4294967295.0F));
    case ComponentType::f32:
      break;
  }
  float value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

}  // namespace

struct GltfFile::Buffer {
  std::string decoded;
  std::unique_ptr<MappedFile> file;
  std::string_view bytes;
};

GltfFile::GltfFile(const MappedFile& file, Progress* progress) : file_(file), progress_(progress) {
  try {
    read_document();
  } catch (const InputError&) {
    file_.check_unchanged();
    throw;
  }
}

void GltfFile::read_document() {
  read_container();
  if (!json_->is_object()) fail("not a glTF document");
  const auto asset = json_->find("asset");
  if (asset == json_->end() || text(*asset, "version").substr(0, 2) != "2.") {
    fail("not a glTF 2.0 document");
  }
  buffers_.resize(count("buffers"));
}

GltfFile::~GltfFile() = default;

void GltfFile::read_container() {
  if (file_.bytes().substr(0, 4) != kMagic) return parse_json(file_.begin(), file_.end());
  constexpr std::size_t kHeader = 12;
  constexpr std::size_t kChunkHeader = 8;
  if (file_.size() < kHeader + kChunkHeader) fail("the file ends too early");
  if (load_uint32(file_.begin() + 4) != 2) fail("not a glTF 2.0 document");
  if (load_uint32(file_.begin() + 8) > file_.size()) fail("the file ends too early");
  std::size_t at = kHeader;
  bool has_json = false;
  while (file_.size() - at >= kChunkHeader) {
    const std::size_t length = load_uint32(file_.begin() + at);
    const std::uint32_t kind = load_uint32(file_.begin() + at + 4);
    at += kChunkHeader;
    if (length > file_.size() - at) fail("a chunk is longer than the file");
    const char* const begin = file_.begin() + at;
    if (!has_json) {
      if (kind != kJsonChunk) fail("the first chunk is not JSON");
      parse_json(begin, begin + length);
      has_json = true;
    } else if (kind == kBinaryChunk && !has_binary_chunk_) {
      binary_chunk_ = {begin, length};
      has_binary_chunk_ = true;
    }
    at += length;
  }
  if (!has_json) fail("the file ends too early");
}

void GltfFile::parse_json(const char* begin, const char* end) {
  if (begin == file_.begin()) text_start(file_);  // refuses UTF-16
  try {
    json_ = std::make_unique<Json>(
        Json::parse(JsonText{begin, begin, end, progress_}, JsonText{end, begin, end, nullptr}));
  } catch (const Json::parse_error& error) {
    const std::size_t at =
        std::min(error.byte == 0 ? 0 : error.byte - 1, static_cast<std::size_t>(end - begin));
    const bool is_text = begin == file_.begin();
    throw InputError(file_.name(), is_text ? file_.line_of(begin + at) : 0, "malformed JSON");
  } catch (const Json::exception&) {
    fail("malformed JSON");
  }
}

std::size_t GltfFile::count(const char* array) const {
  const auto found = json_->find(array);
  if (found == json_->end()) return 0;
  if (!found->is_array()) fail(std::string(array) + " is not an array");
  return found->size();
}

const GltfFile::Json& GltfFile::element(const char* array, std::uint64_t index) const {
  if (index >= count(array)) fail(std::string("index into ") + array + " out of range");
  const Json& found = (*json_)[array][index];
  if (!found.is_object()) fail(std::string("an element of ") + array + " is not an object");
  return found;
}

GltfFile::Json& GltfFile::mutable_node(std::uint64_t index) {
  element("nodes", index);
  return (*json_)["nodes"][index];
}

std::optional<std::uint64_t> GltfFile::find_number(const Json& object, const char* key) const {
  const auto found = object.find(key);
  if (found == object.end()) return std::nullopt;
  if (!found->is_number_unsigned()) fail(std::string(key) + " is not a non-negative integer");
  return found->get<std::uint64_t>();
}

std::optional<std::vector<double>> GltfFile::find_vector(const Json& object, const char* key,
                                                         std::size_t size) const {
  const auto found = object.find(key);
  if (found == object.end()) return std::nullopt;
  std::vector<double> values;
  if (found->is_array()) {
    for (const Json& value : *found) {
      if (value.is_number()) values.push_back(value.get<double>());
    }
  }
  if (values.size() != size || found->size() != size) {
    fail(fmt::format("{} must be an array of {} numbers", key, size));
  }
  return values;
}

std::vector<std::uint64_t> GltfFile::index_list(const Json& object, const char* key) const {
  std::vector<std::uint64_t> list;
  const auto found = object.find(key);
  if (found == object.end()) return list;
  if (!found->is_array()) fail(std::string(key) + " is not an array");
  for (const Json& index : *found) {
    if (!index.is_number_unsigned()) fail("a node index is not a non-negative integer");
    list.push_back(index.get<std::uint64_t>());
  }
  return list;
}

std::string_view GltfFile::text(const Json& object, const char* key) const {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_string()) return {};
  return found->get_ref<const std::string&>();
}

GltfFile::Accessor GltfFile::open_accessor(std::uint64_t index) {
  const Json& json = element("accessors", index);
  Accessor accessor;
  const auto type = component_type(find_number(json, "componentType").value_or(0));
  if (!type) fail("unknown componentType");
  accessor.type = *type;
  static constexpr std::pair<std::string_view, std::size_t> kTypes[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  for (const auto& [name, components] : kTypes) {
    if (text(json, "type") == name) accessor.components = components;
  }
  if (accessor.components == 0) fail("unknown accessor type");
  const auto normalized = json.find("normalized");
  accessor.is_normalized = normalized != json.end() && *normalized == true;
  accessor.stride = accessor.element_bytes();
  const std::uint64_t count = find_number(json, "count").value_or(0);
  const bool has_view = json.contains("bufferView");
  if (has_view) open_data(json, count, accessor);
  accessor.count = static_cast<std::size_t>(count);
  if (!json.contains("sparse")) {
    if (!has_view) fail("an accessor has no data");
    return accessor;
  }
  accessor.bytes = sparse_bytes(index, json, accessor);
  accessor.stride = accessor.element_bytes();
  return accessor;
}

/// Finds the bytes of an accessor with a buffer view.
void GltfFile::open_data(const Json& json, std::uint64_t count, Accessor& accessor) {
  const std::size_t element_bytes = accessor.stride;
  accessor.bytes = view_bytes(*find_number(json, "bufferView"), accessor.stride);
  const std::uint64_t own_offset = find_number(json, "byteOffset").value_or(0);
  if (own_offset > accessor.bytes.size()) fail("an accessor extends past its buffer");
  accessor.bytes.remove_prefix(own_offset);
  if (accessor.stride < element_bytes) fail("byteStride is shorter than an element");
  const std::size_t bytes = accessor.bytes.size();
  if (count != 0 &&
      (bytes < element_bytes || count - 1 > (bytes - element_bytes) / accessor.stride)) {
    fail("an accessor extends past its buffer");
  }
}

/// Returns all elements of an accessor with sparse values, without gaps. `base` has the others,
/// which are zero if it has no bytes.
std::string_view GltfFile::sparse_bytes(std::uint64_t index, const Json& json,
                                        const Accessor& base) {
  const auto known = sparse_.find(index);
  if (known != sparse_.end()) return known->second;
  const std::size_t element_bytes = base.element_bytes();
  make_room(base.count, element_bytes);
  std::string bytes(base.count * element_bytes, '\0');
  for (std::size_t i = 0; i < base.count && !base.bytes.empty(); ++i)
    std::memcpy(&bytes[i * element_bytes], base.bytes.data() + i * base.stride, element_bytes);
  set_sparse(json["sparse"], base, bytes);
  return sparse_.emplace(index, std::move(bytes)).first->second;
}

void GltfFile::set_sparse(const Json& sparse, const Accessor& base, std::string& bytes) {
  if (!sparse.is_object() || !sparse.contains("indices") || !sparse.contains("values") ||
      !sparse["indices"].is_object() || !sparse["values"].is_object()) {
    fail("a sparse accessor needs indices and values");
  }
  const std::uint64_t count = find_number(sparse, "count").value_or(0);
  const auto type = component_type(find_number(sparse["indices"], "componentType").value_or(0));
  if (type != ComponentType::u8 && type != ComponentType::u16 && type != ComponentType::u32) {
    fail("sparse indices are not unsigned integers");
  }
  const std::size_t index_bytes = bytes_of(*type);
  const std::size_t element_bytes = base.element_bytes();
  const std::string_view indices = part_bytes(sparse["indices"], index_bytes, count);
  const std::string_view values = part_bytes(sparse["values"], element_bytes, count);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t at = 0;
    std::memcpy(&at, indices.data() + i * index_bytes, index_bytes);
    if (at >= base.count) fail("a sparse index is out of range");
    std::memcpy(&bytes[at * element_bytes], values.data() + i * element_bytes, element_bytes);
  }
}

std::string_view GltfFile::buffer_bytes(std::uint64_t index) {
  element("buffers", index);
  if (!buffers_[index]) buffers_[index] = open_buffer(index);
  return buffers_[index]->bytes;
}

std::unique_ptr<GltfFile::Buffer> GltfFile::open_buffer(std::uint64_t index) {
  const Json& json = element("buffers", index);
  auto buffer = std::make_unique<Buffer>();
  const std::string_view uri = text(json, "uri");
  if (uri.empty()) {
    if (index != 0 || !has_binary_chunk_) fail("a buffer has no data");
    buffer->bytes = binary_chunk_;
  } else if (uri.starts_with("data:")) {
    buffer->decoded = decoded_uri(uri);
    buffer->bytes = buffer->decoded;
  } else {
    const std::string label = fmt::format("buffer {}", index);
    buffer->file = std::make_unique<MappedFile>(file_of(uri, label), progress_, file_.keep());
    buffer->bytes = buffer->file->bytes();
  }
  const std::uint64_t length = find_number(json, "byteLength").value_or(0);
  if (length > buffer->bytes.size()) fail("a buffer is shorter than its byteLength");
  buffer->bytes = buffer->bytes.substr(0, length);
  return buffer;
}

/// Returns the bytes of a data URI.
std::string GltfFile::decoded_uri(std::string_view uri) const {
  constexpr std::string_view kMark = ";base64,";
  const std::size_t mark = uri.find(kMark);
  if (mark == std::string_view::npos) fail("a data URI is not base64");
  std::optional<std::string> decoded = decode_base64(uri.substr(mark + kMark.size()), progress_);
  if (!decoded) fail("a data URI is not base64");
  return std::move(*decoded);
}

/// Returns the file of a URI. `label`: what the document has there, for messages.
std::filesystem::path GltfFile::file_of(std::string_view uri, std::string_view label) const {
  const Beside found = find_uri_beside(folder(), uri);
  if (found.file.empty()) {
    constexpr std::size_t kMostShown = 100;
    const std::string shown = FileContents::readable(uri.substr(0, kMostShown));
    fail(fmt::format("{} is at {}: {}", label, shown, found.reason()));
  }
  return found.file;
}

std::string GltfFile::resource(std::string_view uri) const {
  if (uri.starts_with("data:")) return decoded_uri(uri);
  const MappedFile file(file_of(uri, "a resource"));
  return read_unchanged(file, [&] { return std::string(file.bytes()); });
}

void GltfFile::check_unchanged() const {
  file_.check_unchanged();
  for (const auto& buffer : buffers_) {
    if (buffer && buffer->file) buffer->file->check_unchanged();
  }
}

std::size_t GltfFile::element_count(std::uint64_t index) {
  return open_accessor(index).count;
}

Array<float> GltfFile::floats(std::uint64_t index, std::size_t components, std::size_t first,
                              std::size_t count) {
  const Accessor accessor = open_accessor(index);
  if (first > accessor.count || count > accessor.count - first) {
    fail("attributes have different lengths");
  }
  Array<float> values(count * components);
  const std::size_t shared = std::min(components, accessor.components);
  ordered_chunks(count, kElementsBetweenReports, progress_, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const char* const from = accessor.bytes.data() + (first + i) * accessor.stride;
      float* const to = values.data() + i * components;
      for (std::size_t c = 0; c < shared; ++c) {
        to[c] =
            load_float(from + c * bytes_of(accessor.type), accessor.type, accessor.is_normalized);
      }
      std::fill(to + shared, to + components, 1.0F);
    }
  });
  return values;
}

Array<std::uint32_t> GltfFile::indices(std::uint64_t index) {
  const Accessor accessor = open_accessor(index);
  if (accessor.components != 1) fail("indices are not scalars");
  Array<std::uint32_t> values(accessor.count);
  const auto load = [&](std::size_t i) {
    const char* const from = accessor.bytes.data() + i * accessor.stride;
    switch (accessor.type) {
      case ComponentType::u8:
        values[i] = static_cast<unsigned char>(*from);
        break;
      case ComponentType::u16:
        values[i] = static_cast<unsigned char>(from[0]) |
                    static_cast<std::uint32_t>(static_cast<unsigned char>(from[1])) << 8;
        break;
      case ComponentType::u32:
        values[i] = load_uint32(from);
        break;
      case ComponentType::s8:
      case ComponentType::s16:
      case ComponentType::f32:
        fail("indices are not unsigned integers");
    }
  };
  ordered_chunks(accessor.count, kElementsBetweenReports, progress_, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      load(i);
  });
  return values;
}

std::size_t GltfFile::byte_count() const {
  std::size_t bytes = file_.size();
  for (const auto& buffer : buffers_) {
    if (buffer && buffer->file) bytes += buffer->bytes.size();
  }
  return bytes;
}

void GltfFile::fail(std::string_view reason) const {
  throw InputError(file_.name(), 0, reason);
}

}  // namespace mesher::io
