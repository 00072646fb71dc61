#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "tests/style/source_files.h"

namespace mesher {
namespace {

/// The namespace of a source file. What core and mesh declare is the vocabulary of all folders, and
/// library defines the face of the library: they are in `mesher` itself.
std::string namespace_of(std::string_view path) {
  if (path.starts_with("app/")) return "mesher::app";
  if (path.starts_with("include/")) return "mesher";
  const std::size_t begin = std::string_view("engine/").size();
  const std::string folder(path.substr(begin, path.find('/', begin) - begin));
  const bool is_common = folder == "core" || folder == "mesh" || folder == "library";
  return is_common ? "mesher" : "mesher::" + folder;
}

/// Returns whether a line opens a namespace of the project other than `expected` or one inside it.
bool opens_other_namespace(std::string_view line, const std::string& expected) {
  constexpr std::string_view kOpening = "namespace mesher";
  if (!line.starts_with(kOpening)) return false;
  const std::string start = "namespace " + expected;
  if (!line.starts_with(start)) return true;
  const std::string_view rest = line.substr(start.size());
  return !rest.starts_with(" {") && !(expected != "mesher" && rest.starts_with("::"));
}

TEST(Namespaces, EveryFolderHasItsOwn) {
  std::size_t found = 0;
  for (const SourceFile& file : source_files({"engine", "app", "include"}, {".h", ".cpp"})) {
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      found += file.lines[i].starts_with("namespace mesher") ? 1U : 0U;
      EXPECT_FALSE(opens_other_namespace(file.lines[i], namespace_of(file.path)))
          << file.path << ":" << i + 1 << ": expected namespace " << namespace_of(file.path);
    }
  }
  EXPECT_GT(found, 300U);
}

TEST(Namespaces, CheckRejectsOtherNamespaces) {
  EXPECT_EQ(namespace_of("engine/simplify/fan.h"), "mesher::simplify");
  EXPECT_EQ(namespace_of("engine/mesh/build/build.h"), "mesher");
  EXPECT_EQ(namespace_of("app/ui/panels.h"), "mesher::app");
  EXPECT_TRUE(opens_other_namespace("namespace mesher {", "mesher::io"));
  EXPECT_TRUE(opens_other_namespace("namespace mesher::io {", "mesher"));
  EXPECT_TRUE(opens_other_namespace("namespace mesher::iota {", "mesher::io"));
  EXPECT_FALSE(opens_other_namespace("namespace mesher::io {", "mesher::io"));
  EXPECT_FALSE(opens_other_namespace("namespace mesher::io::scan {", "mesher::io"));
  EXPECT_FALSE(opens_other_namespace("namespace fs = std::filesystem;", "mesher::io"));
}

}  // namespace
}  // namespace mesher
