#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/style/source_files.h"

namespace mesher {
namespace {

/// The table of docs/architecture.md: what each layer may include besides itself.
const std::map<std::string_view, std::set<std::string_view>> kMayInclude = {
    {"core", {}},
    {"mesh", {"core"}},
    {"io", {"core", "mesh", "simplify", "progressive"}},
    {"simplify", {"core", "mesh", "analysis"}},
    {"subdivide", {"core", "mesh"}},
    {"analysis", {"core", "mesh"}},
    {"progressive", {"core", "mesh", "analysis", "simplify"}},
    {"gpu", {"core"}},
    {"render", {"core", "mesh", "gpu"}},
    {"app",
     {"core", "mesh", "io", "simplify", "subdivide", "analysis", "progressive", "gpu", "render"}},
};

/// The wings of the app, lowest first: each may include those before it. app/main.cpp is above all.
constexpr std::string_view kWings[] = {"document", "edit", "files", "input", "ui", "viewer", "cli"};

/// The one definition of what C++ and GLSL share; plain declarations that belong to no layer.
constexpr std::string_view kSharedWithShaders = "shaders/shared/";

/// "engine/mesh/build.cpp" -> "mesh", "app/ui/panel.h" -> "app"; empty where it is neither.
std::string layer(std::string_view path) {
  if (path.starts_with("app/")) return "app";
  constexpr std::string_view engine = "engine/";
  if (!path.starts_with(engine)) return {};
  path.remove_prefix(engine.size());
  const std::size_t end = path.find('/');
  return end == std::string_view::npos ? std::string{} : std::string(path.substr(0, end));
}

/// Why `path` may not hold this line, if it may not.
std::optional<std::string> objection(std::string_view path, std::string_view line) {
  const std::string include = included(line);
  if (!include.starts_with('"')) return std::nullopt;
  const std::string target = include.substr(1, include.size() - 2);
  if (target.starts_with(".") || target.find("/../") != std::string::npos) {
    return "include relative to the file; write it from the root";
  }
  if (target.starts_with(kSharedWithShaders)) {
    const std::string from = layer(path);
    if (from == "gpu" || from == "render" || from == "app") return std::nullopt;
    return "only gpu, render and app know of shaders";
  }
  const auto rule = kMayInclude.find(layer(path));
  if (rule == kMayInclude.end()) return "its folder is not in the table of layers";
  const std::string to = layer(target);
  if (!kMayInclude.contains(to)) return "includes " + target + ", which is in no layer";
  if (to != rule->first && !rule->second.contains(to)) {
    return std::string(rule->first) + " may not include " + to;
  }
  return std::nullopt;
}

/// The position of a file's wing in kWings; none: it is in no wing.
std::optional<std::size_t> wing(std::string_view path) {
  constexpr std::string_view kApp = "app/";
  if (!path.starts_with(kApp)) return std::nullopt;
  path.remove_prefix(kApp.size());
  const auto found = std::ranges::find(kWings, path.substr(0, path.find('/')));
  if (found == std::end(kWings)) return std::nullopt;
  return static_cast<std::size_t>(found - std::begin(kWings));
}

const std::vector<SourceFile>& sources() {
  static const std::vector<SourceFile> files = source_files({"engine", "app"}, {".h", ".cpp"});
  return files;
}

TEST(Layering, WingsOfTheAppIncludeOnlyWingsBelow) {
  for (const SourceFile& file : sources()) {
    if (!file.path.starts_with("app/") || file.path == "app/main.cpp") continue;
    const auto from = wing(file.path);
    EXPECT_TRUE(from) << file.path << " is in no wing of the table";
    if (!from) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const std::string include = included(file.lines[i]);
      if (!include.starts_with("\"app/")) continue;
      const auto to = wing(include.substr(1, include.size() - 2));
      EXPECT_TRUE(to && *to <= *from)
          << file.path << ":" << i + 1 << ": " << kWings[*from] << " may not include " << include;
    }
  }
}

TEST(Layering, IncludesPointOnlyToLayersBelow) {
  ASSERT_GT(sources().size(), 20U);
  for (const SourceFile& file : sources()) {
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const auto why = objection(file.path, file.lines[i]);
      EXPECT_FALSE(why) << file.path << ":" << i + 1 << ": " << *why;
    }
  }
}

TEST(Layering, TheCheckItselfRefusesWhatItShould) {
  EXPECT_TRUE(objection("engine/core/error.h", "#include \"engine/mesh/mesh.h\""));
  EXPECT_TRUE(objection("engine/mesh/mesh.h", "  #  include \"engine/render/camera.h\""));
  EXPECT_TRUE(objection("engine/io/read.cpp", "#include \"engine/subdivide/masks.h\""));
  EXPECT_TRUE(objection("engine/render/camera.h", "#include \"app/cli.h\""));
  EXPECT_TRUE(objection("engine/mesh/mesh.h", "#include \"../core/error.h\""));
  EXPECT_TRUE(objection("engine/mesh/mesh.h", "#include \"mesh.h\""));
  EXPECT_TRUE(objection("engine/mesh/mesh.h", "#include \"shaders/shared/scene.h\""));
  EXPECT_TRUE(objection("engine/misc/x.h", "#include \"engine/core/error.h\""));
}

TEST(Layering, TheCheckItselfAllowsWhatItShould) {
  EXPECT_FALSE(objection("engine/mesh/mesh.h", "#include \"engine/core/error.h\""));
  EXPECT_FALSE(objection("engine/mesh/mesh.h", "#include \"engine/mesh/ids.h\""));
  EXPECT_FALSE(objection("engine/mesh/mesh.h", "#include <vector>"));
  EXPECT_FALSE(objection("engine/render/surface.cpp", "#include \"shaders/shared/scene.h\""));
  EXPECT_FALSE(objection("app/main.cpp", "#include \"engine/io/read.h\""));
}

using Graph = std::map<std::string, std::vector<std::string>>;

/// Depth-first; the path that comes back to where it has been, or nothing.
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

TEST(Layering, HeadersIncludeNoCycle) {
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

TEST(Layering, TheCheckItselfFindsCycles) {
  EXPECT_TRUE(find_cycle({{"a", {"b", "c"}}, {"b", {"c"}}, {"c", {"d"}}, {"d", {"b"}}}));
  EXPECT_FALSE(find_cycle({{"a", {"b", "c"}}, {"b", {"c"}}, {"c", {"d"}}}));
}

}  // namespace
}  // namespace mesher
