#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/bytes.h"

namespace mesher::test {

/// Puts together a small glTF file of one buffer.
class GltfDocument {
 public:
  /// Adds a buffer view and returns its index. `more`: further JSON members, after a comma.
  int view(const std::string& bytes, const std::string& more = "") {
    while (data_.size() % 4 != 0)
      data_ += '\0';
    views_.push_back(R"({"buffer":0,"byteOffset":)" + std::to_string(data_.size()) +
                     R"(,"byteLength":)" + std::to_string(bytes.size()) + more + "}");
    data_ += bytes;
    return static_cast<int>(views_.size()) - 1;
  }
  /// Adds a buffer view as written and returns its index.
  int raw_view(const std::string& json) {
    views_.push_back(json);
    return static_cast<int>(views_.size()) - 1;
  }
  /// Adds an accessor and returns its index. `data`: "\"bufferView\":0" or what replaces it.
  int accessor(const std::string& data, int component, const std::string& type, std::size_t count) {
    accessors_.push_back("{" + data + (data.empty() ? "" : ",") + R"("componentType":)" +
                         std::to_string(component) + R"(,"type":")" + type + R"(","count":)" +
                         std::to_string(count) + "}");
    return static_cast<int>(accessors_.size()) - 1;
  }
  /// Adds an accessor of floats and returns its index.
  int floats(const std::vector<float>& values, const std::string& type, std::size_t components) {
    return accessor(R"("bufferView":)" + std::to_string(view(bytes_of(values))), 5126, type,
                    values.size() / components);
  }
  int indices(const std::vector<std::uint16_t>& values) {
    return accessor(R"("bufferView":)" + std::to_string(view(bytes_of(values))), 5123, "SCALAR",
                    values.size());
  }
  std::size_t data_size() const { return data_.size(); }

  /// Returns the file. `rest`: further members of the document, such as nodes and meshes.
  std::string text(const std::string& rest) const {
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" +
           std::to_string(data_.size()) + R"(,"uri":"data:application/octet-stream;base64,)" +
           base64(data_) + "\"}]," + list("bufferViews", views_) + "," +
           list("accessors", accessors_) + "," + rest + "}";
  }

 private:
  static std::string list(const std::string& key, const std::vector<std::string>& elements) {
    std::string text = "\"" + key + "\":[";
    for (std::size_t i = 0; i < elements.size(); ++i)
      text += (i > 0 ? "," : "") + elements[i];
    return text + "]";
  }

  std::string data_;
  std::vector<std::string> views_;
  std::vector<std::string> accessors_;
};

/// The corners of two triangles that form the square [0,1] x [0,1].
inline const std::vector<float> kSquareCorners = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
inline const std::vector<std::uint16_t> kSquareIndices = {0, 1, 2, 0, 2, 3};

}  // namespace mesher::test
