#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/io/base64.h"

namespace mesher::test {

/// Returns the bytes of the values in order, in the machine's byte order.
template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

struct StringSink {
  std::string text;
  void write(std::string_view bytes) { text += bytes; }
};

/// Encodes bytes with Base64Writer, one byte at a time.
inline std::string base64(const std::string& bytes) {
  StringSink sink;
  io::Base64Writer<StringSink> writer(sink);
  for (const char byte : bytes)
    writer.write({&byte, 1});
  writer.finish();
  return sink.text;
}

}  // namespace mesher::test
