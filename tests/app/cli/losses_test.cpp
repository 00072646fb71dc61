// Tests that commands either keep what a file holds or name it.
#include <algorithm>

#include "engine/io/format.h"
#include "engine/io/gltf_scene.h"
#include "engine/io/read.h"
#include "tests/app/program_test.h"
#include "tests/support/content_samples.h"
#include "tests/support/sanitized.h"

namespace mesher::test {
namespace {

/// A command that writes a file, and what it puts before the ending of its first file.
struct WritingCommand {
  std::vector<std::string> words;
  std::string suffix;
};

const std::vector<WritingCommand> kCommands = {
    {{"convert"}, ""},
    {{"simplify", "--faces", "2"}, ""},
    {{"subdivide", "--levels", "1"}, ""},
    {{"lods", "--ratios", "1,0.5"}, "_lod0"},
};

FileContents contents_of(const std::filesystem::path& file) {
  const bool is_gltf = file.extension() == ".gltf" || file.extension() == ".glb";
  return is_gltf ? io::GltfScene(file).contents() : io::read_model(file).contents;
}

using Losses = ProgramTest;

// Kinds of content by formats by commands: kept or named, no third case.
TEST_F(Losses, EveryCommandKeepsOrNamesEveryKind) {
  // Each run takes long with sanitizers; the formats differ in code that other tests run.
  const std::vector<std::string> endings =
      kSanitized ? std::vector<std::string>{".glb"}
                 : std::vector<std::string>{".glb", ".gltf", ".obj", ".ply", ".off", ".stl"};
  for (const ContentSample& sample : content_samples()) {
    const auto input = folder_.write("in" + sample.extension, sample.bytes);
    const std::uint64_t held = contents_of(input)[sample.kind];
    ASSERT_GT(held, 0U) << key(sample.kind);
    for (const WritingCommand& command : kCommands) {
      for (const std::string& ending : endings) {
        SCOPED_TRACE(std::string(key(sample.kind)) + " in " + sample.extension + ", " +
                     command.words[0] + " to " + ending);
        std::vector<std::string> words = command.words;
        words.insert(words.end(), {"in" + sample.extension, "-o", "out" + ending});
        const auto lost = mesher_json(words)["lost"].get<std::vector<std::string>>();
        const bool is_one_file = ending == ".glb" || ending == ".gltf";
        const std::string name = "out" + (is_one_file ? "" : command.suffix) + ending;
        const bool is_kept = contents_of(folder_ / name)[sample.kind] >= held;
        EXPECT_TRUE(is_kept || names_any(lost, sample.words));
      }
    }
  }
}

}  // namespace
}  // namespace mesher::test
