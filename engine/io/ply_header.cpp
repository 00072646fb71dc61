#include "engine/io/ply_header.h"

#include <charconv>
#include <utility>

#include "engine/core/error.h"
#include "engine/io/format.h"
#include "engine/io/text_cursor.h"

namespace mesher::io {
namespace {

/// Limit on properties: more than any real file has, and few enough to search quickly.
constexpr std::size_t kMostProperties = 1000;

std::optional<PlyType> type_of(std::string_view name) {
  static constexpr std::pair<std::string_view, PlyType> kNames[] = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  for (const auto& [known, type] : kNames) {
    if (name == known) return type;
  }
  return std::nullopt;
}

class HeaderReader {
 public:
  explicit HeaderReader(const MappedFile& file) : file_(file), p_(text_start(file)) {}

  PlyHeader run() {
    next_line();
    if (line_ != "ply") fail("does not begin with ply");
    for (;;) {
      next_line();
      const std::string_view keyword = word();
      if (keyword == "end_header") break;
      if (keyword == "format") {
        read_format();
      } else if (keyword == "element") {
        read_element();
      } else if (keyword == "property") {
        read_property();
      } else if (keyword == "comment") {
        read_comment();
      } else if (!keyword.empty() && keyword != "obj_info") {
        // A widespread exporter leaves out the word "comment".
        ++header_.skipped_lines;
      }
    }
    if (!has_format_) fail("the header has no format line");
    header_.data = p_;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(std::string_view reason) const {
    throw InputError(file_.name(), line_number_, reason);
  }

  void next_line() {
    ++line_number_;
    const char* const begin = p_;
    while (p_ < file_.end() && *p_ != '\n' && *p_ != '\r')
      ++p_;
    if (p_ >= file_.end()) fail("the header has no end_header line");
    line_ = {begin, static_cast<std::size_t>(p_ - begin)};
    // The first line decides which line end the file uses. After a lone carriage return, a newline
    // may be the first byte of the data.
    if (line_number_ == 1) is_crlf_ = p_[0] == '\r' && p_[1] == '\n';
    p_ += is_crlf_ && p_[0] == '\r' && p_[1] == '\n' ? 2 : 1;
  }

  std::string_view word() {
    const std::size_t begin = std::min(line_.find_first_not_of(" \t"), line_.size());
    line_.remove_prefix(begin);
    const std::size_t end = std::min(line_.find_first_of(" \t"), line_.size());
    const std::string_view found = line_.substr(0, end);
    line_.remove_prefix(end);
    return found;
  }

  void read_format() {
    const std::string_view name = word();
    has_format_ = true;
    if (name == "ascii") {
      header_.encoding = PlyEncoding::text;
    } else if (name == "binary_little_endian") {
      header_.encoding = PlyEncoding::little_endian;
    } else if (name == "binary_big_endian") {
      header_.encoding = PlyEncoding::big_endian;
    } else {
      fail("unknown format");
    }
  }

  /// MeshLab names its textures in comments.
  void read_comment() {
    if (word() != "TextureFile" || header_.textures.size() >= kMostProperties) return;
    const std::size_t begin = std::min(line_.find_first_not_of(" \t"), line_.size());
    header_.textures.emplace_back(line_.substr(begin, kMaxNameBytes));
  }

  void read_element() {
    PlyElement element;
    element.name = word();
    const std::string_view count = word();
    const auto result = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (element.name.empty() || count.empty() || result.ec != std::errc() ||
        result.ptr != count.data() + count.size()) {
      fail("an element needs a name and a count");
    }
    for (const PlyElement& other : header_.elements) {
      if (other.name == element.name) fail("an element is declared twice");
    }
    if (header_.elements.size() >= kMostProperties) fail("too many elements");
    header_.elements.push_back(std::move(element));
  }

  PlyType read_type() {
    const std::optional<PlyType> type = type_of(word());
    if (!type) fail("unknown type");
    return *type;
  }

  void read_property() {
    if (header_.elements.empty()) fail("a property precedes the first element");
    PlyProperty property;
    const std::string_view before = line_;
    if (word() == "list") {
      property.count_type = read_type();
      if (!is_whole(*property.count_type)) fail("a list count must have an integer type");
    } else {
      line_ = before;
    }
    property.type = read_type();
    property.name = word();
    std::vector<PlyProperty>& properties = header_.elements.back().properties;
    if (properties.size() >= kMostProperties) fail("too many properties");
    properties.push_back(std::move(property));
  }

  const MappedFile& file_;
  const char* p_;
  std::string_view line_;
  std::uint64_t line_number_ = 0;
  bool is_crlf_ = false;
  bool has_format_ = false;
  PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::float64:
      return 8;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      break;
  }
  return 4;
}

PlyHeader read_ply_header(const MappedFile& file) {
  return HeaderReader(file).run();
}

}  // namespace mesher::io
