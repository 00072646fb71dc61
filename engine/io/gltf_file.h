#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/array.h"
#include "engine/io/mapped_file.h"

namespace mesher {

/// A glTF 2.0 document with its buffers, whichever of the two containers it came in. Every index,
/// offset and length is checked before use, and nothing is allocated that the bytes do not hold:
/// whoever asks gets data or an InputError.
class GltfFile {
 public:
  using Json = nlohmann::json;

  /// Reads the container (told by its first bytes) and the JSON. Buffers are opened when first
  /// used: the binary chunk, base64 data, or a regular file in or below the document's own folder.
  explicit GltfFile(const MappedFile& file);
  ~GltfFile();
  GltfFile(const GltfFile&) = delete;
  GltfFile& operator=(const GltfFile&) = delete;

  const Json& root() const { return *json_; }
  /// Length of a top-level array, 0 where there is none.
  std::size_t count(const char* array) const;
  /// An element of a top-level array.
  const Json& element(const char* array, std::uint64_t index) const;
  /// A whole number of an object, or nothing where it has no such key.
  std::optional<std::uint64_t> find_number(const Json& object, const char* key) const;
  /// The elements of an array of numbers of an object, or nothing where it has no such key. Fails
  /// where there are not `size` of them.
  std::optional<std::vector<double>> find_vector(const Json& object, const char* key,
                                                 std::size_t size) const;
  /// A text of an object, or "" where it has none. Valid as long as the document.
  std::string_view text(const Json& object, const char* key) const;

  /// Number of elements of an accessor, all of which are there.
  std::size_t element_count(std::uint64_t accessor);
  /// Values of elements [first, first + count) of an accessor, `components` to an element: those it
  /// lacks are 1, those it has more are left out. Normalized integers become fractions.
  Array<float> floats(std::uint64_t accessor, std::size_t components, std::size_t first,
                      std::size_t count);
  /// All values of a scalar accessor of unsigned integers.
  Array<std::uint32_t> indices(std::uint64_t accessor);
  /// Bytes of the document and of all buffers opened so far.
  std::size_t byte_count() const;

  [[noreturn]] void fail(std::string_view reason) const;

 private:
  struct Accessor;
  struct Buffer;

  void read_container();
  void parse_json(const char* begin, const char* end);
  Accessor open_accessor(std::uint64_t index);
  std::string_view view_bytes(const Json& accessor, std::size_t& stride);
  std::string_view buffer_bytes(std::uint64_t index);
  std::unique_ptr<Buffer> open_buffer(std::uint64_t index);

  const MappedFile& file_;
  std::unique_ptr<Json> json_;
  std::string_view binary_chunk_;
  bool has_binary_chunk_ = false;
  std::vector<std::unique_ptr<Buffer>> buffers_;
};

}  // namespace mesher
