#include "app/cli/edit_command.h"

#include <gtest/gtest.h>

#include "engine/io/read.h"
#include "tests/app/program_test.h"

namespace mesher::test {
namespace {

using EditCommand = ProgramTest;

TEST(SplitScript, DropsBlanksAndEmptyParts) {
  EXPECT_EQ(app::split_script(" a ; b x=1;; \n c;"), (std::vector<std::string>{"a", "b x=1", "c"}));
  EXPECT_TRUE(app::split_script(" ; ").empty());
}

TEST_F(EditCommand, RunsCommandsAndEditsInOrder) {
  const auto json =
      mesher_json({"edit", "knot", "-o", "k.obj", "--do",
                   "next_scheme; subdivide; simplify_to faces=500 cost=length; undo"});
  EXPECT_EQ(json["faces"], 4 * 2880);
  ASSERT_EQ(json["edits"].size(), 1U);
  EXPECT_NE(json["edits"][0]["edit"].get<std::string>().find("scheme=butterfly"),
            std::string::npos);
  EXPECT_EQ(io::read_model(folder_ / "k.obj").mesh.face_count(), 4U * 2880U);
}

TEST_F(EditCommand, EqualsTheCommandsOfTheirOwn) {
  ASSERT_EQ(mesher({"edit", "knot", "-o", "a.obj", "--do", "simplify_to faces=700"}).exit_code, 0);
  ASSERT_EQ(mesher({"edit", "cube", "-o", "b.obj", "--do", "subdivide; subdivide"}).exit_code, 0);
  ASSERT_EQ(mesher({"subdivide", "cube", "-o", "d.obj", "--levels", "2"}).exit_code, 0);
  EXPECT_EQ(io::read_model(folder_ / "a.obj").mesh.face_count(), 700U);
  EXPECT_EQ(read_bytes(folder_ / "b.obj"), read_bytes(folder_ / "d.obj"));
}

TEST_F(EditCommand, EditsScenes) {
  ASSERT_EQ(mesher({"convert", "knot", "k.glb"}).exit_code, 0);
  const auto json = mesher_json({"edit", "k.glb", "-o", "e.glb", "--do", "simplify; subdivide"});
  EXPECT_EQ(io::read_model(folder_ / "e.glb").mesh.face_count(), json["faces"]);
}

TEST_F(EditCommand, UsesLevelsOfAProgressiveMesh) {
  ASSERT_EQ(mesher({"progressive", "knot", "-o", "k.pm"}).exit_code, 0);
  const auto json =
      mesher_json({"edit", "k.pm", "-o", "k.ply", "--do", "keep_level splits=100; subdivide"});
  EXPECT_EQ(json["edits"].size(), 2U);
  const Finished extracted = mesher({"edit", "k.pm", "-o", "x.ply", "--do", "least_detail"});
  EXPECT_EQ(extracted.exit_code, 0) << extracted.err;
  EXPECT_LT(io::read_model(folder_ / "x.ply").mesh.face_count(), 1000U);
}

TEST_F(EditCommand, SaysWhatWasRefused) {
  const Finished run = mesher({"edit", "cube", "-o", "c.obj", "--do", "undo"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_TRUE(holds(run.err, "undo: nothing to undo")) << run.err;
}

TEST_F(EditCommand, RefusesBeforeItReads) {
  const std::pair<const char*, const char*> bad[] = {
      {"polish", "there is no command 'polish'"},
      {"subdivde", "there is no command 'subdivde'; did you mean subdivide?"},
      {"quit", "'quit' works in the window only"},
      {"toggle_wireframe", "'toggle_wireframe' works in the window only"},
      {";", "there is nothing to do"},
  };
  for (const auto& [script, reason] : bad) {
    const Finished run = mesher({"edit", "missing.obj", "-o", "c.obj", "--do", script});
    EXPECT_EQ(run.exit_code, 1) << script;
    EXPECT_TRUE(holds(run.err, reason)) << run.err;
  }
  const Finished run = mesher({"edit", "cube", "-o", "c.obj", "--do", "simplify_to faces=x"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "c.obj"));
}

}  // namespace
}  // namespace mesher::test
