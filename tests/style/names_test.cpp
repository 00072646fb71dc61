#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/style/source_files.h"

namespace mesher {
namespace {

/// Returns the types that a file defines directly in a named namespace, as "mesher::app::Window".
/// Relies on clang-format: definitions directly in a namespace are not indented.
std::vector<std::string> types_of(const SourceFile& file) {
  static const std::regex kNamespace(R"(^(inline )?namespace ([\w:]+) \{$)");
  static const std::regex kType(
      R"(^(template <.*> )?(enum class|enum|struct|class|union) (alignas\(\d+\) )?(\w+)( final)?( : [^;(]+)? \{.*)");
  std::vector<std::string> types;
  std::string space;
  bool is_anonymous = false;
  for (const std::string& line : file.lines) {
    std::smatch match;
    if (std::regex_match(line, match, kNamespace)) space = match[2];
    if (line == "namespace {") is_anonymous = true;
    if (line == "}  // namespace") is_anonymous = false;
    if (!is_anonymous && std::regex_match(line, match, kType)) {
      types.push_back(space + "::" + match[4].str());
    }
  }
  return types;
}

std::map<std::string, std::set<std::string>> files_by_type(const std::vector<SourceFile>& files) {
  std::map<std::string, std::set<std::string>> result;
  for (const SourceFile& file : files) {
    for (const std::string& type : types_of(file))
      result[type].insert(file.path);
  }
  return result;
}

// The linker treats two types with one name in one namespace as one type, and does not report if
// they differ.
TEST(Names, NoTypeIsDefinedTwice) {
  const auto files = files_by_type(source_files({"engine", "app", "include"}, {".h", ".cpp"}));
  ASSERT_GT(files.size(), 150U);
  ASSERT_TRUE(files.contains("mesher::Mesh"));
  ASSERT_TRUE(files.contains("mesher::simplify::VertexState"));
  for (const auto& [type, paths] : files)
    EXPECT_EQ(paths.size(), 1U) << type << ": " << *paths.begin() << ", " << *paths.rbegin();
}

TEST(Names, CheckFindsTypeDefinitions) {
  const SourceFile file{
      "engine/x.h",
      {"namespace mesher {", "namespace {", "struct Hidden {", "};", "}  // namespace",
       "class Declared;", "class Base : public Other {", "enum class Kind : std::uint8_t { a, b };",
       "struct alignas(64) Line {", "template <class T> struct Box {", "struct Outer::Inner {",
       "  struct Nested {", "struct Plain {", "struct Made f() {"}};
  EXPECT_EQ(types_of(file),
            (std::vector<std::string>{"mesher::Base", "mesher::Kind", "mesher::Line", "mesher::Box",
                                      "mesher::Plain"}));
  const auto twice = files_by_type({file, {"engine/y.h", {"namespace mesher {", "enum Plain {"}}});
  EXPECT_EQ(twice.at("mesher::Plain").size(), 2U);
}

}  // namespace
}  // namespace mesher
