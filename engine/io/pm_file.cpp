#include "engine/io/pm_file.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <new>
#include <set>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/io/extension.h"
#include "engine/io/format.h"
#include "engine/io/mapped_file.h"
#include "engine/io/pm_materials.h"
#include "engine/progressive/codec/pm_read.h"

namespace mesher::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPmReadBlock = std::size_t{1} << 16;
/// Times of decoding, and of refining to full detail, which decoding has mostly done.
constexpr double kReadWeights[] = {0.99, 0.01};

/// Number of bytes that identify a file.
constexpr std::size_t kBeginning = 8;

/// Checks the format of a file whose name does not tell it. Throws InputError if it is not a
/// progressive mesh.
void check_kind(const std::string& name, std::span<const std::byte> begin) {
  if (begin.size() >= kBeginning && progressive::PmReader::is_pm(begin)) return;
  throw InputError(
      name, 0,
      "is not a progressive mesh; files of other formats, and named pipes, need one of the "
      "extensions " +
          writable_formats());
}

/// A pipe. Reads no more than requested, because the pipe may never end.
class Pipe {
 public:
  Pipe(std::string name, Progress* progress) : name_(std::move(name)), progress_(progress) {
    // Open without blocking: a pipe without a writer must not delay cancellation.
    // A socket can be duplicated, but not opened again.
    const int own = descriptor_of(name_);
    descriptor_ = own >= 0 ? ::fcntl(own, F_DUPFD_CLOEXEC, 0)
                           : ::open(name_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) fail("cannot open");
  }
  ~Pipe() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  /// Waits for the next bytes and returns them; empty at the end. The next call overwrites them.
  std::span<const std::byte> read() {
    for (;;) {
      while (!has_news(kCancelCheckMs))
        check_cancelled();
      const ssize_t got = ::read(descriptor_, block_.data(), block_.size());
      if (got >= 0) return std::span(block_).first(static_cast<std::size_t>(got));
      if (errno != EINTR && errno != EAGAIN) fail("cannot read");
      check_cancelled();
    }
  }

  /// Returns whether data or the end of the pipe is available within `milliseconds`.
  bool has_news(int milliseconds) const {
    // A named pipe reads as ended until a writer opens it; poll tells the difference.
    pollfd readable{descriptor_, POLLIN, 0};
    return ::poll(&readable, 1, milliseconds) > 0;
  }

 private:
  static constexpr int kCancelCheckMs = 100;

  void check_cancelled() const {
    if (progress_ != nullptr && progress_->is_cancelled()) throw Cancelled();
  }
  [[noreturn]] void fail(const char* action) const {
    throw InputError(name_, 0, std::string(action) + ": " + std::generic_category().message(errno));
  }

  std::string name_;
  Progress* progress_;
  int descriptor_ = -1;
  std::vector<std::byte> block_ = std::vector<std::byte>(kPmReadBlock);
};

bool begins_like_pm(const fs::path& file) {
  std::array<std::byte, kBeginning> begin{};
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(begin.data()), begin.size());
  return in.gcount() == std::streamsize{begin.size()} && progressive::PmReader::is_pm(begin);
}

void feed_all(progressive::PmReader& reader, std::span<const std::byte> bytes, Progress* progress) {
  for (std::size_t begin = 0; begin < bytes.size(); begin += kPmReadBlock) {
    report(progress, static_cast<float>(double(begin) / double(bytes.size())));
    reader.feed(bytes.subspan(begin, std::min(kPmReadBlock, bytes.size() - begin)));
    if (!reader.damage().empty()) break;
  }
  reader.finish();
}

/// Feeds a whole regular file. Returns its size in bytes.
std::uint64_t feed_file(progressive::PmReader& reader, const fs::path& file, Progress* progress) {
  const MappedFile mapped(file, progress);
  if (mapped.size() == 0) throw InputError(mapped.name(), 0, "is empty");
  const auto bytes = std::as_bytes(std::span(mapped.begin(), mapped.size()));
  if (!has_pm_ending(file)) check_kind(mapped.name(), bytes);
  reader.expect_splits(progressive::PmReader::count_splits(bytes));
  return read_unchanged(mapped, [&] {
    feed_all(reader, bytes, progress);
    return bytes.size();
  });
}

/// Feeds the bytes that identify the content of a pipe. Returns how many bytes were fed.
std::uint64_t feed_beginning(progressive::PmReader& reader, Pipe& pipe, const fs::path& file) {
  std::vector<std::byte> begin;
  while (begin.size() < kBeginning) {
    const auto bytes = pipe.read();
    if (bytes.empty()) break;
    begin.insert(begin.end(), bytes.begin(), bytes.end());
  }
  if (begin.empty()) throw InputError(file.string(), 0, "is empty");
  if (!has_pm_ending(file)) check_kind(file.string(), begin);
  reader.feed(begin);
  return begin.size();
}

/// Feeds the mesh of a pipe and returns its number of bytes. Reads no further than the mesh: the
/// rest may be endless, or its writer may pause.
std::uint64_t feed_pipe(progressive::PmReader& reader, const fs::path& file, Progress* progress) {
  Pipe pipe(file.string(), progress);
  reader.ignore_what_follows();
  std::uint64_t fed = feed_beginning(reader, pipe, file);
  while (reader.damage().empty() && !reader.is_complete()) {
    const auto bytes = pipe.read();
    if (bytes.empty()) break;
    reader.feed(bytes);
    fed += bytes.size();
    const double splits = reader.has_base() ? reader.mesh().split_count() : 0;
    report(progress, static_cast<float>(splits / std::max(1U, reader.announced_splits())));
  }
  reader.finish();
  return reader.is_complete() ? reader.used_bytes() : fed;
}

PmSummary summary_of(const progressive::ProgressiveMesh& mesh) {
  PmSummary summary;
  summary.base_vertices = mesh.base_vertex_count();
  summary.base_faces = mesh.base_face_count();
  summary.splits = summary.announced_splits = mesh.split_count();
  summary.vertices = mesh.base_vertex_count() + mesh.split_count();
  summary.faces = mesh.full_face_count();
  return summary;
}

/// Makes the groups of a file refer to nothing that is not there. Their meshes belong to the scene
/// of another file.
void check_groups(progressive::ProgressiveAttributes& attributes, const Materials* materials) {
  const std::size_t count = materials == nullptr ? 0 : materials->materials.size();
  for (std::size_t k = 0; k < attributes.groups().size(); ++k) {
    FaceGroup& group = attributes.group_entry(k);
    if (group.material >= count) group.material = kNone;
    group.mesh = kNone;
    group.primitive = kNone;
    for (std::string* name : {&group.object, &group.name, &group.smoothing}) {
      if (name->size() > kMaxNameBytes) name->resize(kMaxNameBytes);
    }
  }
}

Content content_of(AttributeKind kind) {
  switch (kind) {
    case AttributeKind::texcoord:
      return Content::uv_sets;
    case AttributeKind::normal:
      return Content::normals;
    case AttributeKind::tangent:
      return Content::tangents;
    case AttributeKind::color:
      return Content::color_sets;
    case AttributeKind::joints:
      return Content::joint_sets;
    case AttributeKind::weights:  // one set with the joints
    case AttributeKind::delta:
    case AttributeKind::custom:
      break;
  }
  return Content::own_properties;
}

void add_names(FileContents& contents, Content kind, const std::vector<FaceGroup>& groups,
               std::string FaceGroup::*name) {
  std::set<std::string> names;
  for (const FaceGroup& group : groups) {
    if (!(group.*name).empty() && names.insert(group.*name).second) contents.add(kind, group.*name);
  }
}

/// Notes what the file holds.
void note_contents(const progressive::ProgressiveAttributes& attributes, FileContents& contents) {
  for (const AttributeLayer& layer : attributes.layers()) {
    const AttributeType& type = layer.type();
    contents.note_attribute(FileContents::readable(type_text(type)));
    const Content kind = content_of(type.kind);
    if (kind != Content::own_properties) ++contents[kind];
  }
  add_names(contents, Content::groups, attributes.groups(), &FaceGroup::name);
  add_names(contents, Content::objects, attributes.groups(), &FaceGroup::object);
  add_names(contents, Content::smoothing_groups, attributes.groups(), &FaceGroup::smoothing);
}

}  // namespace

bool has_pm_ending(const fs::path& file) {
  const FormatInfo* format = format_of(file);
  return format != nullptr && format->extension == std::string_view(".pm");
}

bool is_pipe(const fs::path& file) {
  std::error_code ignored;
  return fs::is_fifo(file, ignored) || fs::is_socket(file, ignored);
}

bool is_pm_file(const fs::path& file) {
  if (has_pm_ending(file)) return true;
  std::error_code ignored;
  if (fs::is_regular_file(file, ignored)) return begins_like_pm(file);
  return format_of(file) == nullptr && is_pipe(file);
}

std::shared_ptr<const Materials> take_materials(std::span<const std::byte> appendix,
                                                const fs::path& file,
                                                progressive::ProgressiveAttributes& attributes,
                                                FileContents& contents) {
  std::shared_ptr<const Materials> materials = decode_pm_materials(appendix, file, contents);
  check_groups(attributes, materials.get());
  note_contents(attributes, contents);
  return materials;
}

PmContents read_pm_file(const fs::path& file, Progress* progress) {
  begin_stage(progress, "reading");
  Stages stages(progress, kReadWeights);
  stages.next();
  try {
    progressive::PmReader reader(file.string());
    PmSummary rest;
    rest.bytes =
        is_pipe(file) ? feed_pipe(reader, file, progress) : feed_file(reader, file, progress);
    rest.announced_splits = reader.announced_splits();
    rest.coordinate_bits = reader.coordinate_bits();
    rest.damage = reader.damage();
    rest.attribute_bytes = reader.attribute_bytes();
    PmContents contents;
    contents.materials =
        take_materials(reader.appendix(), file, reader.attributes(), contents.contents);
    contents.attributes = reader.take_attributes();
    contents.mesh = std::move(reader).take();
    stages.next();
    go_to_level(contents.mesh, contents.mesh.split_count(), progress);
    contents.attributes.go_to(contents.attributes.split_count());
    PmSummary& summary = contents.summary;
    summary = summary_of(contents.mesh);
    summary.announced_splits = rest.announced_splits;
    summary.coordinate_bits = rest.coordinate_bits;
    summary.bytes = rest.bytes;
    summary.attribute_bytes = rest.attribute_bytes;
    summary.damage = std::move(rest.damage);
    return contents;
  } catch (const std::bad_alloc&) {
    throw_out_of_memory(file.string());
  }
}

void check_intact(const fs::path& file, const PmSummary& summary) {
  if (!summary.damage.empty()) throw InputError(file.string(), 0, "is damaged: " + summary.damage);
}

progressive::PmSizes write_pm_file(AtomicFile& file, progressive::ProgressiveMesh& mesh,
                                   const progressive::PmWriteOptions& options) {
  begin_stage(options.progress, "writing");
  try {
    return progressive::write_pm(mesh, options, [&](std::span<const std::byte> bytes) {
      file.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    });
  } catch (const OutputError& error) {
    // The encoder does not know the file name; errors of the file itself already contain it.
    const std::string_view what = error.what();
    if (what.starts_with(file.name() + ": ")) throw;
    throw OutputError(file.name(), what);
  }
}

progressive::PmSizes write_pm_file(AtomicFile& file, progressive::ProgressiveMesh& mesh,
                                   progressive::PmWriteOptions options,
                                   const Materials* materials) {
  const std::string appendix = encode_pm_materials(materials);
  options.appendix = std::as_bytes(std::span(appendix));
  return write_pm_file(file, mesh, options);
}

PmSummary summary_of(const progressive::ProgressiveMesh& mesh,
                     const progressive::PmWriteOptions& options,
                     const progressive::PmSizes& sizes) {
  PmSummary summary = summary_of(mesh);
  summary.coordinate_bits = options.coordinate_bits;
  summary.bytes = sizes.total;
  summary.attribute_bytes = sizes.attributes;
  return summary;
}

}  // namespace mesher::io
