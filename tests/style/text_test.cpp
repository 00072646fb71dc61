#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/style/source_files.h"

namespace mesher {
namespace {

std::vector<SourceFile> everything() {
  return source_files(
      {"engine", "app", "cmake", "include", "shaders", "tests", "docs", "scripts", "assets"},
      {".h", ".cpp", ".txt", ".md", ".glsl", ".vert", ".frag", ".comp", ""});
}

/// Returns the number of the first line that contains `word`, from 1; 0: none does.
std::size_t find_line(const SourceFile& file, std::string_view word) {
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    if (file.lines[i].find(word) != std::string::npos) return i + 1;
  }
  return 0;
}

// The words are put together here, so that this file does not contain them.
std::vector<std::string> words(std::string_view prefix, const std::vector<std::string>& rest) {
  std::vector<std::string> result;
  for (const std::string& word : rest)
    result.push_back(std::string(prefix) + word);
  return result;
}

void expect_none_holds(const std::vector<std::string>& unwanted) {
  const std::vector<SourceFile> files = everything();
  ASSERT_GT(files.size(), 40U);
  for (const SourceFile& file : files) {
    for (const std::string& word : unwanted) {
      const std::size_t line = find_line(file, word);
      EXPECT_EQ(line, 0U) << file.path << ":" << line << ": contains " << word;
    }
  }
}

TEST(Text, FilesContainNoMachinePaths) {
  expect_none_holds(words("/", {"home/", "root/", "work/"}));
}

TEST(Text, FilesContainNoDeferredWorkOrSilencedWarnings) {
  expect_none_holds(words("TO", {"DO"}));
  expect_none_holds(words("FIX", {"ME"}));
  expect_none_holds(words("NO", {"LINT"}));
}

/// Returns whether a line is the label of one of our enumerators: "case Scheme::loop:". Enumerators
/// of Vulkan and of other libraries have no scope.
bool is_own_label(std::string_view line) {
  const std::size_t at = line.find_first_not_of(' ');
  if (at == std::string_view::npos || !line.substr(at).starts_with("case ")) return false;
  const std::string_view label = line.substr(at + 5);
  return label.find("::") != std::string_view::npos &&
         std::isalpha(static_cast<unsigned char>(label.front())) != 0;
}

// The compiler reports an enumerator that a switch misses only if there is no default.
TEST(Text, SwitchesOverOwnEnumsListEveryCase) {
  for (const SourceFile& file : source_files({"engine", "app", "include"}, {".h", ".cpp"})) {
    std::set<std::size_t> columns;  // of our labels in the enclosing switches
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const std::string& line = file.lines[i];
      const std::size_t column = line.find_first_not_of(' ');
      if (column == std::string::npos) continue;
      if (is_own_label(line)) columns.insert(column);
      if (line.substr(column).starts_with("switch (")) columns.erase(column + 2);
      const bool is_default = line.substr(column).starts_with("default:");
      EXPECT_FALSE(is_default && columns.contains(column))
          << file.path << ":" << i + 1 << ": a default hides enumerators without a case";
    }
  }
}

TEST(Text, HeadersStartWithPragmaOnce) {
  for (const SourceFile& file : source_files({"engine", "app", "include", "tests"}, {".h"})) {
    ASSERT_FALSE(file.lines.empty()) << file.path;
    EXPECT_EQ(file.lines.front(), "#pragma once") << file.path;
  }
}

TEST(Text, FilesStayBelowLineLimit) {
  for (const SourceFile& file : source_files({"engine", "app", "include"}, {".h", ".cpp"})) {
    const std::size_t limit = file.path.ends_with(".h") ? 300 : 500;
    EXPECT_LE(file.lines.size(), limit) << file.path << " is longer than " << limit << " lines";
  }
}

/// Names in the lists of scripts/bootstrap: the first word of each line of `*_packages="..."`.
std::vector<std::string> packages_installed() {
  std::ifstream script(MESHER_SOURCE_DIR "/scripts/bootstrap");
  std::vector<std::string> names;
  bool is_list = false;
  for (std::string line; std::getline(script, line);) {
    std::istringstream words(line);
    std::string name;
    if (is_list && words >> name) names.push_back(name);
    if (line.ends_with("_packages=\"")) {
      is_list = true;
    } else if (line.ends_with('"')) {
      is_list = false;
    }
  }
  return names;
}

/// Names in the first column of the README's table of dependencies.
std::set<std::string> packages_explained() {
  std::ifstream readme(MESHER_SOURCE_DIR "/README.md");
  std::set<std::string> names;
  for (std::string line; std::getline(readme, line);) {
    if (!line.starts_with("| ")) continue;
    std::istringstream column(line.substr(2, line.find('|', 2) - 2));
    for (std::string name; column >> name;) {
      names.insert(name.ends_with(',') ? name.substr(0, name.size() - 1) : name);
    }
  }
  return names;
}

TEST(Text, ReadmeExplainsEveryInstalledPackage) {
  const std::set<std::string> explained = packages_explained();
  const std::vector<std::string> installed = packages_installed();
  EXPECT_GT(installed.size(), 20U);
  for (const std::string& name : installed)
    EXPECT_TRUE(explained.contains(name)) << name;
}

TEST(Text, SearchFindsWords) {
  const SourceFile file{"a.cpp", {"one", "two three"}};
  EXPECT_EQ(find_line(file, "three"), 2U);
  EXPECT_EQ(find_line(file, "four"), 0U);
}

}  // namespace
}  // namespace mesher
