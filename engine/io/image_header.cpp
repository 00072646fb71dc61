#include "engine/io/image_header.h"

namespace mesher::io {
namespace {

/// The bytes of a header. Beyond the end they are 0.
class HeaderBytes {
 public:
  explicit HeaderBytes(std::string_view bytes) : bytes_(bytes) {}

  std::size_t size() const { return bytes_.size(); }
  bool has(std::size_t at, std::string_view text) const {
    return at <= bytes_.size() && bytes_.substr(at).starts_with(text);
  }
  std::uint32_t byte(std::size_t at) const {
    return at < bytes_.size() ? static_cast<unsigned char>(bytes_[at]) : 0;
  }
  /// Returns a number whose first byte counts most.
  std::uint32_t big(std::size_t at, std::size_t count) const {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < count; ++i)
      number = number << 8U | byte(at + i);
    return number;
  }
  /// Returns a number whose first byte counts least.
  std::uint32_t little(std::size_t at, std::size_t count) const {
    std::uint32_t number = 0;
    for (std::size_t i = count; i-- > 0;)
      number = number << 8U | byte(at + i);
    return number;
  }

 private:
  std::string_view bytes_;
};

ImageHeader png_header(const HeaderBytes& bytes) {
  if (!bytes.has(12, "IHDR") || bytes.size() < 24) return {ImageCoding::png};
  return {ImageCoding::png, bytes.big(16, 4), bytes.big(20, 4)};
}

/// Returns whether a marker begins a frame. Three of its range define tables (ITU-T T.81, table
/// B.1).
bool is_frame(std::uint32_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

bool has_no_length(std::uint32_t marker) {
  return marker <= 0x01 || (marker >= 0xd0 && marker <= 0xd8);
}

ImageHeader jpeg_header(const HeaderBytes& bytes) {
  std::size_t at = 2;
  while (at + 9 <= bytes.size()) {
    const std::uint32_t marker = bytes.byte(at + 1);
    // Any number of bytes may fill the space before a marker.
    if (bytes.byte(at) != 0xff || marker == 0xff) {
      ++at;
    } else if (has_no_length(marker)) {
      at += 2;
    } else if (is_frame(marker)) {
      return {ImageCoding::jpeg, bytes.big(at + 7, 2), bytes.big(at + 5, 2)};
    } else {
      at += 2 + bytes.big(at + 2, 2);
    }
  }
  return {ImageCoding::jpeg};
}

/// Source: RFC 9649.
ImageHeader webp_header(const HeaderBytes& bytes) {
  constexpr std::uint32_t k14Bits = (1U << 14U) - 1;
  if (bytes.has(12, "VP8X") && bytes.size() >= 30)
    return {ImageCoding::webp, bytes.little(24, 3) + 1, bytes.little(27, 3) + 1};
  if (bytes.has(12, "VP8L") && bytes.size() >= 25) {
    const std::uint32_t sides = bytes.little(21, 4);
    return {ImageCoding::webp, (sides & k14Bits) + 1, (sides >> 14U & k14Bits) + 1};
  }
  if (bytes.has(12, "VP8 ") && bytes.size() >= 30)
    return {ImageCoding::webp, bytes.little(26, 2) & k14Bits, bytes.little(28, 2) & k14Bits};
  return {ImageCoding::webp};
}

}  // namespace

ImageHeader read_image_header(std::string_view bytes) {
  const HeaderBytes header(bytes);
  if (header.has(0, "\x89PNG\r\n\x1a\n")) return png_header(header);
  if (header.has(0, "\xff\xd8\xff")) return jpeg_header(header);
  if (header.has(0, "RIFF") && header.has(8, "WEBP")) return webp_header(header);
  if (header.has(0, "\xABKTX 20\xBB\r\n\x1a\n") && header.size() >= 28)
    return {ImageCoding::unknown, header.little(20, 4), header.little(24, 4)};
  if (header.has(0, "DDS ") && header.size() >= 20)
    return {ImageCoding::unknown, header.little(16, 4), header.little(12, 4)};
  return {};
}

}  // namespace mesher::io
