#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/core/array.h"
#include "engine/core/progress.h"
#include "engine/io/mapped_file.h"
#include "engine/mesh/attributes.h"

namespace mesher::io {

/// A glTF 2.0 document with its buffers, from either container.
///
/// Every index, offset and length is checked before use. No allocation is larger than the file's
/// bytes justify. A query returns data or throws InputError.
class GltfFile {
 public:
  using Json = nlohmann::json;

  /// Reads the container (identified by its first bytes) and the JSON. Buffers are opened on first
  /// use. A buffer is the binary chunk, base64 data, or a regular file in or below the document's
  /// own folder.
  /// Reading the document is the current stage of `progress`, and so is each later query that reads
  /// data, unless a Reports says otherwise. Each may throw Cancelled. `progress` may be null.
  GltfFile(const MappedFile& file, Progress* progress);
  ~GltfFile();
  GltfFile(const GltfFile&) = delete;
  GltfFile& operator=(const GltfFile&) = delete;

  const Json& root() const { return *json_; }
  /// Returns the length of a top-level array, or 0 if it is absent.
  std::size_t count(const char* array) const;
  /// Returns an element of a top-level array.
  const Json& element(const char* array, std::uint64_t index) const;
  /// Returns a node, to be changed in memory. The file stays as it is.
  Json& mutable_node(std::uint64_t index);
  /// Returns the unsigned integer at a key of an object, or nothing if the key is absent.
  std::optional<std::uint64_t> find_number(const Json& object, const char* key) const;
  /// Returns the array of numbers at a key of an object, or nothing if the key is absent. Throws
  /// InputError if it does not have `size` elements.
  std::optional<std::vector<double>> find_vector(const Json& object, const char* key,
                                                 std::size_t size) const;
  /// Returns the array of indices at a key of an object, empty if the key is absent.
  std::vector<std::uint64_t> index_list(const Json& object, const char* key) const;
  /// Returns the string at a key of an object, or "" if the key is absent. Valid as long as the
  /// document.
  std::string_view text(const Json& object, const char* key) const;

  /// Returns an extension of an object, or null.
  const Json* extension(const Json& object, const char* name) const;

  /// The elements of an accessor, all within a buffer.
  struct Accessor {
    std::string_view bytes;  ///< starts at the first element
    std::size_t count = 0;
    std::size_t stride = 0;  ///< from one element to the next, in bytes
    std::size_t components = 0;
    ComponentType type = ComponentType::f32;
    bool is_normalized = false;

    std::size_t element_bytes() const { return components * bytes_of(type); }
  };
  /// Returns an accessor with its sparse values in place. Valid as long as the document.
  Accessor open_accessor(std::uint64_t index);
  /// Returns the number of elements of an accessor. All of them lie within the buffer.
  std::size_t element_count(std::uint64_t accessor);
  /// Returns elements [first, first + count) of an accessor, with `components` values per element.
  /// Missing components are 1; surplus ones are dropped. Normalized integers become fractions.
  Array<float> floats(std::uint64_t accessor, std::size_t components, std::size_t first,
                      std::size_t count);
  /// Returns the integer that stands for 1 in an accessor of normalized integers, or 0 for others.
  double full_value(std::uint64_t accessor) const;
  /// Returns all values of a scalar accessor of unsigned integers.
  Array<std::uint32_t> indices(std::uint64_t accessor);
  /// Returns the bytes of a buffer view that is not compressed.
  std::string_view plain_view(std::uint64_t index);
  /// Returns the bytes that a buffer view, or an extension of one, refers to, as they are stored.
  std::string_view range_of(const Json& view);
  /// Returns the bytes of a data URI, or of a regular file in or below the document's own folder.
  std::string resource(std::string_view uri) const;
  /// Returns the folder that URIs are relative to.
  std::filesystem::path folder() const;
  /// Throws InputChanged if another program changed the document or a buffer that was opened.
  void check_unchanged() const;
  /// Returns the size in bytes of the document and of the external buffers opened so far.
  std::size_t byte_count() const;

  [[noreturn]] void fail(std::string_view reason) const;

  /// Has the queries of a document report to another progress, or to none, while it lives. Code
  /// that keeps a document for longer than the progress that it was read with needs one.
  class Reports {
   public:
    Reports(GltfFile& gltf, Progress* progress)
        : gltf_(gltf), before_(std::exchange(gltf.progress_, progress)) {}
    ~Reports() { gltf_.progress_ = before_; }
    Reports(const Reports&) = delete;
    Reports& operator=(const Reports&) = delete;

   private:
    GltfFile& gltf_;
    Progress* before_;
  };

 private:
  struct Buffer;

  void read_document();
  void read_container();
  void parse_json(const char* begin, const char* end);
  void open_data(const Json& json, std::uint64_t count, Accessor& accessor);
  std::string_view sparse_bytes(std::uint64_t index, const Json& json, const Accessor& base);
  void set_sparse(const Json& sparse, const Accessor& base, std::string& bytes);
  void make_room(std::uint64_t count, std::uint64_t element_bytes);
  std::string_view part_bytes(const Json& part, std::size_t element_bytes, std::uint64_t count);
  std::string_view view_bytes(std::uint64_t index, std::size_t& stride);
  std::string_view decoded_view(std::uint64_t index, const Json& view, const Json& compression);
  std::string_view buffer_bytes(std::uint64_t index);
  std::unique_ptr<Buffer> open_buffer(std::uint64_t index);
  std::string decoded_uri(std::string_view uri) const;
  std::filesystem::path file_of(std::string_view uri, std::string_view label) const;

  const MappedFile& file_;
  Progress* progress_;
  std::unique_ptr<Json> json_;
  std::string_view binary_chunk_;
  bool has_binary_chunk_ = false;
  std::vector<std::unique_ptr<Buffer>> buffers_;
  /// Accessors with sparse values or without a buffer view, with all values in place.
  std::unordered_map<std::uint64_t, std::string> sparse_;
  std::unordered_map<std::uint64_t, std::string> decoded_views_;
  std::size_t made_bytes_ = 0;  ///< of both
};

}  // namespace mesher::io
