#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/style/source_files.h"

namespace mesher {
namespace {

using Layers = std::map<std::string, std::set<std::string>, std::less<>>;

/// The words between commas and spaces.
std::set<std::string> words_of(std::string_view text) {
  std::set<std::string> words;
  std::string word;
  for (const char c : std::string(text) + ",") {
    if (c == ',' || c == ' ') {
      if (!word.empty()) words.insert(std::exchange(word, {}));
    } else {
      word += c;
    }
  }
  return words;
}

/// Reads the table "| layer | may include |" of docs/architecture.md.
Layers read_layers() {
  std::ifstream page(MESHER_SOURCE_DIR "/docs/architecture.md");
  Layers layers;
  bool is_inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line == "| layer | may include |") is_inside = true;
    if (is_inside && !line.starts_with("|")) break;
    if (!is_inside || line.starts_with("| layer") || line.starts_with("|---")) continue;
    const std::size_t bar = line.find('|', 1);
    const std::set<std::string> name = words_of(line.substr(1, bar - 1));
    const std::size_t end = line.rfind('|');
    layers[*name.begin()] = words_of(line.substr(bar + 1, end - bar - 1));
  }
  return layers;
}

const Layers& layers() {
  static const Layers table = read_layers();
  return table;
}

/// Declarations that C++ and GLSL share. They belong to no layer.
constexpr std::string_view kSharedWithShaders = "shaders/shared/";

/// "engine/mesh/build/build.cpp" -> "mesh", "app/ui/panel.h" -> "ui"; empty: the file is in no
/// layer.
std::string layer(std::string_view path) {
  for (const std::string_view root : {"engine/", "app/"}) {
    if (!path.starts_with(root)) continue;
    path.remove_prefix(root.size());
    const std::size_t end = path.find('/');
    return end == std::string_view::npos ? std::string{} : std::string(path.substr(0, end));
  }
  return {};
}

/// Returns why `path` may not contain this line, or none if it may.
std::optional<std::string> objection(std::string_view path, std::string_view line) {
  const std::string include = included(line);
  if (!include.starts_with('"')) return std::nullopt;
  const std::string target = include.substr(1, include.size() - 2);
  if (target.starts_with(".") || target.find("/../") != std::string::npos) {
    return "include relative to the file; write it from the root";
  }
  if (target.ends_with(".cpp")) return "includes a source";
  if (target.starts_with(kSharedWithShaders)) {
    const std::string from = layer(path);
    if (from == "gpu" || from == "render" || path.starts_with("app/")) return std::nullopt;
    return "only gpu, render and app may include shader headers";
  }
  if (path == "app/main.cpp") return std::nullopt;  // is above all layers
  const auto rule = layers().find(layer(path));
  if (rule == layers().end()) return "its folder is not in the table of layers";
  const std::string to = layer(target);
  if (!layers().contains(to)) return "includes " + target + ", which is in no layer";
  if (to != rule->first && !rule->second.contains(to)) {
    return std::string(rule->first) + " may not include " + to;
  }
  return std::nullopt;
}

const std::vector<SourceFile>& sources() {
  static const std::vector<SourceFile> files = source_files({"engine", "app"}, {".h", ".cpp"});
  return files;
}

TEST(Layering, FilesIncludeOnlyLowerLayers) {
  ASSERT_GT(sources().size(), 20U);
  for (const SourceFile& file : sources()) {
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const auto why = objection(file.path, file.lines[i]);
      EXPECT_FALSE(why) << file.path << ":" << i + 1 << ": " << *why;
    }
  }
}

TEST(Layering, EveryFolderIsInTable) {
  std::set<std::string> folders;
  for (const SourceFile& file : sources())
    folders.insert(layer(file.path));
  folders.erase("");  // app/main.cpp
  std::set<std::string> listed;
  for (const auto& [name, included] : layers())
    listed.insert(name);
  EXPECT_EQ(folders, listed);
}

TEST(Layering, CheckRejectsForbiddenIncludes) {
  EXPECT_TRUE(objection("app/document/x.h", "#include \"app/ui/panels.h\""));
  EXPECT_TRUE(objection("engine/io/x.h", "#include \"app/document/session.h\""));
  EXPECT_TRUE(objection("engine/core/error.h", "#include \"engine/mesh/mesh.h\""));
  EXPECT_TRUE(objection("engine/mesh/mesh.h", "  #  include \"engine/render/camera.h\""));
  EXPECT_TRUE(objection("engine/io/read.cpp", "#include \"engine/subdivide/masks.h\""));
  EXPECT_TRUE(objection("engine/render/camera.h", "#include \"app/cli.h\""));
  EXPECT_TRUE(objection("engine/scene/animation.h", "#include \"engine/io/read.h\""));
  EXPECT_TRUE(objection("engine/mesh/mesh.h", "#include \"../core/error.h\""));
  EXPECT_TRUE(objection("engine/mesh/mesh.h", "#include \"mesh.h\""));
  EXPECT_TRUE(objection("engine/mesh/mesh.h", "#include \"shaders/shared/scene.h\""));
  EXPECT_TRUE(objection("engine/mesh/mesh.cpp", "#include \"engine/mesh/normals.cpp\""));
  EXPECT_TRUE(objection("engine/misc/x.h", "#include \"engine/core/error.h\""));
}

TEST(Layering, CheckAcceptsAllowedIncludes) {
  EXPECT_FALSE(objection("engine/mesh/mesh.h", "#include \"engine/core/error.h\""));
  EXPECT_FALSE(objection("engine/mesh/mesh.h", "#include \"engine/mesh/ids.h\""));
  EXPECT_FALSE(objection("engine/mesh/mesh.h", "#include <vector>"));
  EXPECT_FALSE(objection("engine/io/read.h", "#include \"engine/scene/animation.h\""));
  EXPECT_FALSE(objection("engine/render/surface.cpp", "#include \"shaders/shared/scene.h\""));
  EXPECT_FALSE(objection("app/main.cpp", "#include \"engine/io/read.h\""));
}

using Graph = std::map<std::string, std::vector<std::string>>;

/// Searches depth-first for a path that returns to one of its files.
std::optional<std::string> find_cycle(const Graph& graph, const std::string& at,
                                      std::vector<std::string>& path, std::set<std::string>& done) {
  if (std::ranges::find(path, at) != path.end()) {
    std::string cycle;
    for (const std::string& file : path)
      cycle += file + " -> ";
    return cycle + at;
  }
  const auto node = graph.find(at);
  if (node == graph.end() || !done.insert(at).second) return std::nullopt;
  path.push_back(at);
  for (const std::string& next : node->second) {
    if (auto cycle = find_cycle(graph, next, path, done)) return cycle;
  }
  path.pop_back();
  return std::nullopt;
}

std::optional<std::string> find_cycle(const Graph& graph) {
  std::set<std::string> done;
  for (const auto& [file, includes] : graph) {
    std::vector<std::string> path;
    if (auto cycle = find_cycle(graph, file, path, done)) return cycle;
  }
  return std::nullopt;
}

TEST(Layering, IncludesHaveNoCycle) {
  Graph graph;
  for (const SourceFile& file : sources()) {
    for (const std::string& line : file.lines) {
      const std::string include = included(line);
      if (include.starts_with('"')) {
        graph[file.path].push_back(include.substr(1, include.size() - 2));
      }
    }
  }
  const auto cycle = find_cycle(graph);
  EXPECT_FALSE(cycle) << *cycle;
}

TEST(Layering, CheckFindsCycles) {
  EXPECT_TRUE(find_cycle({{"a", {"b", "c"}}, {"b", {"c"}}, {"c", {"d"}}, {"d", {"b"}}}));
  EXPECT_FALSE(find_cycle({{"a", {"b", "c"}}, {"b", {"c"}}, {"c", {"d"}}}));
}

}  // namespace
}  // namespace mesher
