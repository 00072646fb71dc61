#include "engine/io/draco_mesh.h"

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <cstring>

#include "engine/io/child_process.h"

namespace mesher::io {
namespace {

/// Bytes that decoded data may always have, and how many more per byte of the data: a triangle
/// takes at least about a bit.
constexpr std::size_t kAlwaysDecodedBytes = std::size_t{1} << 26;
constexpr std::size_t kMostDecodedPerByte = 1024;
constexpr std::uint32_t kMostComponents = 4;

template <class T>
std::string_view raw_bytes(const T* values, std::size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof(T)};
}

/// Writes the number of points and of triangles, the indices, and for each attribute the number of
/// components, whether values are fractions, and the values.
bool write_mesh(const draco::Mesh& mesh, std::span<const std::uint32_t> ids,
                const ChildWriter& write) {
  const std::uint32_t counts[2] = {mesh.num_points(), mesh.num_faces()};
  if (!write(raw_bytes(counts, 2))) return false;
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
    const draco::Mesh::Face& face = mesh.face(f);
    const std::uint32_t corners[3] = {face[0].value(), face[1].value(), face[2].value()};
    if (!write(raw_bytes(corners, 3))) return false;
  }
  for (const std::uint32_t id : ids) {
    const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(id);
    if (attribute == nullptr || attribute->num_components() > int(kMostComponents)) return false;
    const std::uint32_t head[2] = {static_cast<std::uint32_t>(attribute->num_components()),
                                   attribute->normalized() ? 1U : 0U};
    if (!write(raw_bytes(head, 2))) return false;
    for (draco::PointIndex p(0); p < mesh.num_points(); ++p) {
      float value[kMostComponents] = {};
      attribute->ConvertValue<float>(attribute->mapped_index(p), static_cast<std::int8_t>(head[0]),
                                     value);
      if (!write(raw_bytes(value, head[0]))) return false;
    }
  }
  return true;
}

/// Collects small pieces, because each write is a call of the system.
class BufferedWriter {
 public:
  explicit BufferedWriter(const ChildWriter& write) : write_(write) {}
  bool put(std::string_view bytes) {
    buffer_ += bytes;
    return buffer_.size() < kBlock || flush();
  }
  bool flush() {
    const bool is_written = write_(buffer_);
    buffer_.clear();
    return is_written;
  }

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 16;
  const ChildWriter& write_;
  std::string buffer_;
};

bool decode_in_child(std::string_view bytes, std::span<const std::uint32_t> ids,
                     const ChildWriter& write) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return false;
  BufferedWriter out(write);
  return write_mesh(*decoded.value(), ids,
                    [&](std::string_view piece) { return out.put(piece); }) &&
         out.flush();
}

/// Takes values from the front of the child's output.
class OutputReader {
 public:
  explicit OutputReader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  bool take(T* values, std::size_t count) {
    if (count > bytes_.size() / sizeof(T)) return false;
    if (count > 0) std::memcpy(values, bytes_.data(), count * sizeof(T));
    bytes_.remove_prefix(count * sizeof(T));
    return true;
  }
  std::size_t left() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
};

/// The child decoded hostile data, so its output is checked like a file.
std::optional<DracoMesh> read_output(std::string_view bytes, std::size_t attributes) {
  OutputReader in(bytes);
  DracoMesh mesh;
  std::uint32_t counts[2];
  if (!in.take(counts, 2) || counts[1] > in.left() / 12) return std::nullopt;
  mesh.points = counts[0];
  mesh.indices.resize(std::size_t{3} * counts[1]);
  if (!in.take(mesh.indices.data(), mesh.indices.size())) return std::nullopt;
  for (const std::uint32_t index : mesh.indices) {
    if (index >= mesh.points) return std::nullopt;
  }
  for (std::size_t i = 0; i < attributes; ++i) {
    std::uint32_t head[2];
    if (!in.take(head, 2) || head[0] == 0 || head[0] > kMostComponents) return std::nullopt;
    const std::size_t count = std::size_t{head[0]} * mesh.points;
    if (count > in.left() / sizeof(float)) return std::nullopt;
    DracoAttribute attribute{.components = head[0], .is_fraction = head[1] != 0, .values = {}};
    attribute.values.resize(count);
    if (!in.take(attribute.values.data(), count)) return std::nullopt;
    mesh.attributes.push_back(std::move(attribute));
  }
  return mesh;
}

}  // namespace

std::optional<DracoMesh> decode_draco(std::string_view bytes, std::span<const std::uint32_t> ids,
                                      std::string& problem, Progress* progress) {
  const ChildLimits limits{.output = kAlwaysDecodedBytes + kMostDecodedPerByte * bytes.size()};
  const ChildResult result =
      run_in_child([&](const ChildWriter& write) { return decode_in_child(bytes, ids, write); },
                   limits, progress);
  if (result.outcome == ChildOutcome::done) {
    std::optional<DracoMesh> mesh = read_output(result.bytes, ids.size());
    if (mesh) return mesh;
  }
  problem = result.outcome == ChildOutcome::died       ? "its Draco data crashes the decoder"
            : result.outcome == ChildOutcome::too_long ? "its Draco data is too long when decoded"
                                                       : "its Draco data is damaged";
  return std::nullopt;
}

}  // namespace mesher::io
