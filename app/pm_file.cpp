#include "app/pm_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <new>
#include <span>
#include <utility>

#include "engine/core/error.h"
#include "engine/io/format.h"
#include "engine/io/mapped_file.h"
#include "engine/progressive/pm_read.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBlock = std::size_t{1} << 18;

bool begins_like_pm(const fs::path& file) {
  std::array<std::byte, 8> begin{};
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(begin.data()), begin.size());
  return in.gcount() == std::streamsize{begin.size()} && PmReader::is_pm(begin);
}

void feed_all(PmReader& reader, std::span<const std::byte> bytes, Progress* progress) {
  for (std::size_t begin = 0; begin < bytes.size(); begin += kBlock) {
    report(progress, static_cast<float>(double(begin) / double(bytes.size())));
    reader.feed(bytes.subspan(begin, std::min(kBlock, bytes.size() - begin)));
    if (!reader.damage().empty()) break;
  }
  reader.finish();
}

PmSummary summary_of(const ProgressiveMesh& mesh) {
  PmSummary summary;
  summary.base_vertices = mesh.base_vertex_count();
  summary.base_faces = mesh.base_face_count();
  summary.splits = summary.announced_splits = mesh.split_count();
  summary.vertices = mesh.base_vertex_count() + mesh.split_count();
  summary.faces = mesh.full_face_count();
  return summary;
}

}  // namespace

bool has_pm_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".pm";
}

bool is_pm_file(const fs::path& file) {
  if (has_pm_ending(file)) return true;
  std::error_code ignored;
  if (fs::is_regular_file(file, ignored)) return begins_like_pm(file);
  return !format_of(file) && (fs::is_fifo(file, ignored) || fs::is_socket(file, ignored));
}

PmContents read_pm_file(const fs::path& file, Progress* progress) {
  begin_stage(progress, "reading " + file.filename().string());
  try {
    const MappedFile bytes(file, progress);
    if (bytes.size() == 0) throw InputError(bytes.name(), 0, "is empty");
    PmReader reader(bytes.name());
    feed_all(reader, std::as_bytes(std::span(bytes.begin(), bytes.size())), progress);
    PmSummary rest;
    rest.announced_splits = reader.announced_splits();
    rest.coordinate_bits = reader.coordinate_bits();
    rest.damage = reader.damage();
    PmContents contents{std::move(reader).take(), {}};
    contents.mesh.go_to(contents.mesh.split_count());
    PmSummary& summary = contents.summary;
    summary = summary_of(contents.mesh);
    summary.announced_splits = rest.announced_splits;
    summary.coordinate_bits = rest.coordinate_bits;
    summary.bytes = bytes.size();
    summary.damage = std::move(rest.damage);
    return contents;
  } catch (const std::bad_alloc&) {
    throw DeviceError(file.string() + ": not enough memory");
  }
}

PmSizes write_pm_file(AtomicFile& file, ProgressiveMesh& mesh, const PmWriteOptions& options) {
  begin_stage(options.progress, "writing");
  return write_pm(mesh, options, [&](std::span<const std::byte> bytes) {
    file.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  });
}

PmSummary summary_of(const ProgressiveMesh& mesh, const PmWriteOptions& options,
                     const PmSizes& sizes) {
  PmSummary summary = summary_of(mesh);
  summary.coordinate_bits = options.coordinate_bits;
  summary.bytes = sizes.total;
  return summary;
}

}  // namespace mesher::app
