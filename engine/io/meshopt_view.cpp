#include "engine/io/meshopt_view.h"

#include <meshoptimizer.h>

#include <cstddef>

namespace mesher::io {
namespace {

/// The codec for vertices spends at least 2 bits on 16 bytes, and a byte on a triangle.
constexpr std::uint64_t kMostRatio = 80;
constexpr std::uint64_t kAlwaysDecoded = std::uint64_t{1} << 16;

bool has_filter(const MeshoptView& view) {
  return !view.filter.empty() && view.filter != "NONE";
}

bool fits_filter(const MeshoptView& view) {
  if (!has_filter(view)) return true;
  if (view.mode != "ATTRIBUTES") return false;
  if (view.filter == "OCTAHEDRAL") return view.stride == 4 || view.stride == 8;
  if (view.filter == "QUATERNION") return view.stride == 8;
  return view.filter == "EXPONENTIAL";
}

void apply_filter(const MeshoptView& view, std::string& decoded) {
  const auto count = static_cast<std::size_t>(view.count);
  const auto stride = static_cast<std::size_t>(view.stride);
  if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(decoded.data(), count, stride);
  if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(decoded.data(), count, stride);
  if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(decoded.data(), count, stride);
}

}  // namespace

std::string objection(const MeshoptView& view, std::uint64_t decoded_bytes) {
  const bool is_index = view.mode == "TRIANGLES" || view.mode == "INDICES";
  if (!is_index && view.mode != "ATTRIBUTES") return "unknown mode of EXT_meshopt_compression";
  const bool is_stride_valid = is_index
                                   ? view.stride == 2 || view.stride == 4
                                   : view.stride % 4 == 0 && view.stride >= 4 && view.stride <= 256;
  if (!is_stride_valid || (view.mode == "TRIANGLES" && view.count % 3 != 0)) {
    return "invalid byteStride or count of EXT_meshopt_compression";
  }
  if (!fits_filter(view)) return "unknown filter of EXT_meshopt_compression";
  if (view.count > kMostRatio * (view.bytes.size() + kAlwaysDecoded) / view.stride) {
    return "a compressed view is too long for its bytes";
  }
  if (view.count * view.stride < decoded_bytes) {
    return "a compressed view is shorter than its byteLength";
  }
  return "";
}

bool decode_meshopt(const MeshoptView& view, std::string& decoded) {
  const auto count = static_cast<std::size_t>(view.count);
  const auto stride = static_cast<std::size_t>(view.stride);
  decoded.assign(count * stride, '\0');
  const auto* const bytes = reinterpret_cast<const unsigned char*>(view.bytes.data());
  int error = 0;
  if (view.mode == "ATTRIBUTES") {
    error = meshopt_decodeVertexBuffer(decoded.data(), count, stride, bytes, view.bytes.size());
  } else if (view.mode == "TRIANGLES") {
    error = meshopt_decodeIndexBuffer(decoded.data(), count, stride, bytes, view.bytes.size());
  } else {
    error = meshopt_decodeIndexSequence(decoded.data(), count, stride, bytes, view.bytes.size());
  }
  if (error != 0) return false;
  apply_filter(view, decoded);
  return true;
}

}  // namespace mesher::io
