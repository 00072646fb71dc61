#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "tests/style/source_files.h"

namespace mesher {
namespace {

std::vector<SourceFile> everything() {
  return source_files({"engine", "app", "shaders", "tests", "docs", "scripts", "assets"},
                      {".h", ".cpp", ".txt", ".md", ".glsl", ".vert", ".frag", ".comp", ".py"});
}

/// First line of the file that holds `word`, from 1; 0: none does.
std::size_t find_line(const SourceFile& file, std::string_view word) {
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    if (file.lines[i].find(word) != std::string::npos) return i + 1;
  }
  return 0;
}

// The words are put together here, so that this file does not hold them.
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
      EXPECT_EQ(line, 0U) << file.path << ":" << line << ": holds " << word;
    }
  }
}

TEST(Text, NoPathsOfOneMachine) {
  expect_none_holds(words("/", {"home/", "root/", "work/"}));
}

TEST(Text, NothingIsPutOffOrSilenced) {
  expect_none_holds(words("TO", {"DO"}));
  expect_none_holds(words("FIX", {"ME"}));
  expect_none_holds(words("NO", {"LINT"}));
}

TEST(Text, HeadersAreIncludedOnce) {
  for (const SourceFile& file : source_files({"engine", "app", "tests"}, {".h"})) {
    ASSERT_FALSE(file.lines.empty()) << file.path;
    EXPECT_EQ(file.lines.front(), "#pragma once") << file.path;
  }
}

TEST(Text, FilesStayReadable) {
  for (const SourceFile& file : source_files({"engine", "app"}, {".h", ".cpp"})) {
    const std::size_t limit = file.path.ends_with(".h") ? 300 : 500;
    EXPECT_LE(file.lines.size(), limit) << file.path << " is longer than " << limit << " lines";
  }
}

TEST(Text, TheSearchItselfFinds) {
  const SourceFile file{"a.cpp", {"one", "two three"}};
  EXPECT_EQ(find_line(file, "three"), 2U);
  EXPECT_EQ(find_line(file, "four"), 0U);
}

}  // namespace
}  // namespace mesher
