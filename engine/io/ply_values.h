#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "engine/core/error.h"
#include "engine/io/mapped_file.h"
#include "engine/io/ply_header.h"
#include "engine/io/text_cursor.h"

namespace mesher::io {

/// Reads values one by one from a text file.
class PlyTextValues {
 public:
  PlyTextValues(const MappedFile& file, const char* data) : text_(file, data) {}
  static constexpr std::size_t least_bytes(PlyType) { return 1; }

  /// Returns a bound on the number of values that may follow.
  std::size_t bytes_left() const { return text_.bytes_left() / 2 + 1; }
  std::size_t file_bytes_left() const { return text_.bytes_left(); }
  float next_float(PlyType) { return text_.number(); }
  /// Returns a value in single precision, and raises `error` to its distance from the file's
  /// number.
  float coordinate(PlyType, double& error) { return text_.coordinate(error); }
  double next(PlyType) { return text_.wide_number(); }
  std::int64_t next_whole(PlyType) { return text_.integer(); }
  void skip(PlyType) { text_.word(); }
  /// A row is one line. A line with more values belongs to another element, for example if a count
  /// is wrong.
  void end_row() {
    if (!text_.at_row_end()) text_.fail("a line has more values than the header declares");
  }
  [[noreturn]] void fail(std::string_view reason) { text_.fail(reason); }

 private:
  TextCursor text_;
};

/// Reads values from a binary file. `kSwapped`: its byte order is not the machine's.
template <bool kSwapped>
class PlyBinaryValues {
 public:
  PlyBinaryValues(const MappedFile& file, const char* data) : file_(file), p_(data) {}
  static std::size_t least_bytes(PlyType type) { return size_of(type); }

  std::size_t bytes_left() const { return static_cast<std::size_t>(file_.end() - p_); }
  std::size_t file_bytes_left() const { return bytes_left(); }
  float next_float(PlyType type) {
    return type == PlyType::float32 ? take<float>() : static_cast<float>(next(type));
  }
  float coordinate(PlyType type, double& error) {
    if (type == PlyType::float32) return take<float>();
    const double wide = next(type);
    const auto value = static_cast<float>(wide);
    const double distance = std::abs(wide - static_cast<double>(value));
    if (std::isfinite(distance)) error = std::max(error, distance);
    return value;
  }
  double next(PlyType type) {
    switch (type) {
      case PlyType::float32:
        return static_cast<double>(take<float>());
      case PlyType::float64:
        return take<double>();
      case PlyType::int8:
      case PlyType::uint8:
      case PlyType::int16:
      case PlyType::uint16:
      case PlyType::int32:
      case PlyType::uint32:
        break;
    }
    return static_cast<double>(next_whole(type));
  }
  std::int64_t next_whole(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      case PlyType::float32:
      case PlyType::float64:
        break;
    }
    fail("indices must be integers");
  }
  void skip(PlyType type) { need(size_of(type)), p_ += size_of(type); }
  void end_row() {}
  [[noreturn]] void fail(std::string_view reason) { throw InputError(file_.name(), 0, reason); }

 private:
  void need(std::size_t bytes) {
    if (bytes_left() < bytes) fail("the file ends too early");
  }
  template <class T>
  T take() {
    need(sizeof(T));
    char bytes[sizeof(T)];
    std::memcpy(bytes, p_, sizeof(T));
    if constexpr (kSwapped) std::reverse(bytes, bytes + sizeof(T));
    p_ += sizeof(T);
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  const MappedFile& file_;
  const char* p_;
};

}  // namespace mesher::io
