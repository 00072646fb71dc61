#pragma once

#include <filesystem>
#include <string>

namespace mesher::io {

/// Returns the extension that tells the format of a file, in lower case: ".obj". That is the one of
/// its name, or the one of a NamedFormat.
std::string extension_of(const std::filesystem::path& file);

/// Returns whether a file is one that the process has open: /dev/stdin, /dev/stdout, /dev/stderr,
/// /dev/fd/N or /proc/self/fd/N. Such a name tells no format, and no files can lie beside it.
bool is_open_file(const std::filesystem::path& file);
/// Returns the descriptor that such a name means, or -1. The file behind it must not be replaced by
/// a rename: with a shell's `>>`, its old content would be lost.
int descriptor_of(const std::filesystem::path& file);

/// Says which format a file has whose name does not tell it, such as a pipe, for the whole process
/// while it lives. Create it before other threads start. Pre: no other one names the same file.
class NamedFormat {
 public:
  /// `extension`: ".obj", in lower case.
  NamedFormat(std::filesystem::path file, std::string extension);
  ~NamedFormat();
  NamedFormat(const NamedFormat&) = delete;
  NamedFormat& operator=(const NamedFormat&) = delete;

 private:
  std::filesystem::path file_;
};

}  // namespace mesher::io
