#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace mesher::test {

/// A temporary folder for one test. The destructor deletes it with everything in it.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  /// Returns the number of files in the folder.
  std::size_t count_files() const;
  /// Writes a file into the folder and returns its path.
  std::filesystem::path write(std::string_view name, std::string_view bytes) const;

 private:
  std::filesystem::path path_;
};

/// Returns all bytes of a file.
std::string read_bytes(const std::filesystem::path& file);

}  // namespace mesher::test
