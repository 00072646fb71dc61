#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/io/atomic_file.h"
#include "engine/io/base64.h"
#include "engine/io/block_writer.h"

namespace mesher::io {

/// The parts of a glTF file, as JSON texts.
struct GltfParts {
  std::string document;              ///< an object with at least one member, without "buffers"
  std::vector<std::string> buffers;  ///< objects; the first one has the data, without "uri"
  std::uint64_t bytes = 0;           ///< of the data, a multiple of 4
};

/// Writes a document and its data, binary (.glb) or as text with the data embedded.
/// `write_data(sink)` writes exactly `bytes` bytes by sink.write(std::string_view). Does not
/// commit. Throws OutputError for a .glb of more than 4 GB, the limit of the format.
/// `File` is AtomicFile, or anything with `write(std::string_view)` and `name()`.
template <class File, class WriteData>
void write_container(File& file, const GltfParts& parts, bool binary, const WriteData& write_data) {
  std::string rest;  // what follows the first buffer
  for (std::size_t i = 1; i < parts.buffers.size(); ++i)
    rest += "," + parts.buffers[i];
  if (!binary) {
    if (parts.buffers.empty()) return file.write(parts.document);
    // The data is written before the rest of the document, which is complete by now, so that the
    // document need not hold it as well.
    std::string first = parts.buffers.front();
    first.pop_back();
    file.write("{\"buffers\":[" + first);
    if (parts.bytes > 0) {
      file.write(",\"uri\":\"data:application/octet-stream;base64,");
      Base64Writer<File> text(file);
      write_data(text);
      text.finish();
      file.write("\"");
    }
    file.write("}" + rest + "]," + parts.document.substr(1));
    return;
  }
  std::string json = parts.document;
  if (!parts.buffers.empty()) {
    json.pop_back();
    json += ",\"buffers\":[" + parts.buffers.front() + rest + "]}";
  }
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::uint64_t data_chunk = parts.bytes > 0 ? 8 + parts.bytes : 0;
  const std::uint64_t total = 12 + 8 + json.size() + data_chunk;
  if (total > std::numeric_limits<std::uint32_t>::max())
    throw OutputError(file.name(), "glTF cannot hold more than 4 GB");
  Appender head;
  head.need(64);
  head << "glTF";
  head.raw(std::uint32_t{2}).raw(static_cast<std::uint32_t>(total));
  head.raw(static_cast<std::uint32_t>(json.size())) << "JSON";
  file.write(head.text());
  file.write(json);
  if (parts.bytes == 0) return;
  head.clear();
  head.raw(static_cast<std::uint32_t>(parts.bytes)) << std::string_view("BIN\0", 4);
  file.write(head.text());
  write_data(file);
}

}  // namespace mesher::io
