#include "engine/io/mtl_read.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include "engine/core/error.h"
#include "engine/io/format.h"
#include "engine/io/text_cursor.h"

namespace mesher::io {

void MtlReader::read(const MappedFile& file) {
  file_ = std::filesystem::path(file.name()).filename().string();
  line_ = 0;
  if (file.size() > kMostMtlBytes - bytes_)
    throw InputError(file.name(), 0, "too large for a material file");
  bytes_ += file.size();
  std::string joined;  // of a line that a backslash continues
  std::uint64_t lines = 0;
  for (const char* p = text_start(file); p < file.end();) {
    const char* const end = std::find(p, file.end(), '\n');
    std::string_view line(p, static_cast<std::size_t>(end - p));
    ++lines;
    if (joined.empty()) line_ = lines;
    p = end == file.end() ? end : end + 1;
    while (!line.empty() && static_cast<unsigned char>(line.back()) <= ' ')
      line.remove_suffix(1);
    if (line.ends_with('\\') && p != file.end()) {
      joined += line.substr(0, line.size() - 1);
      joined += ' ';
      continue;
    }
    joined += line;
    read_line(joined);
    joined.clear();
  }
  end_material();
}

void MtlReader::read_line(std::string_view line) {
  const MtlStatement statement = split_mtl(line);
  if (statement.keyword.empty()) return;
  if (statement.keyword == "newmtl") return begin_material(statement.rest);
  if (!look_) return;
  std::string text(line.substr(std::min(line.find_first_not_of(" \t\r\v\f"), line.size())));
  std::ranges::replace(text, '\0', '_');
  if (!look_->add(text)) warn("malformed " + text.substr(0, kMaxNameBytes));
  materials_.materials.back().mtl_statements->push_back(std::move(text));
}

void MtlReader::begin_material(std::string_view name) {
  end_material();
  if (materials_.materials.size() >= kMostMtlMaterials) {
    if (!std::exchange(is_full_, true)) warn("further materials are ignored");
    return;
  }
  materials_.materials.push_back({.name = std::string(name.substr(0, kMaxNameBytes)),
                                  .mtl_statements = std::vector<std::string>()});
  look_.emplace([this](std::string_view file) { return image_of(file); });
}

void MtlReader::end_material() {
  if (look_) look_->finish(materials_.materials.back());
  look_.reset();
}

/// Returns the index of an image by the text that names it.
std::uint32_t MtlReader::image_of(std::string_view file) {
  const auto known = images_.find(std::string(file));
  if (known != images_.end()) return known->second;
  const auto index = static_cast<std::uint32_t>(materials_.images.size());
  if (index == kMostMtlImages) {
    warn("further textures are ignored");
    return kNone;
  }
  materials_.images.push_back({.path = std::string(file)});
  images_.emplace(file, index);
  return index;
}

void MtlReader::warn(std::string_view reason) {
  contents_.warn(file_ + (line_ > 0 ? ":" + std::to_string(line_) : "") + ": " +
                 std::string(reason));
}

}  // namespace mesher::io
