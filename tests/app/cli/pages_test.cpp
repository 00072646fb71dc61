// Tests the man pages and completions that are made from the table of commands.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "app/cli/command_table.h"
#include "app/cli/completion.h"
#include "app/cli/man_page.h"
#include "tests/support/process.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

const CommandTable& table() {
  static const CommandTable kTable = command_table();
  return kTable;
}

const CommandInfo& command(const std::string& name) {
  return *std::ranges::find(table().commands, name, &CommandInfo::name);
}

const ArgumentInfo& option(const CommandInfo& info, const std::string& name) {
  return *std::ranges::find_if(info.options, [&](const ArgumentInfo& argument) {
    return std::ranges::find(argument.names, name) != argument.names.end();
  });
}

class Completion : public ::testing::Test {
 protected:
  /// Runs a shell in a folder with a model, another file and a subfolder. Returns what it prints,
  /// in one line.
  std::string completed(std::vector<std::string> shell, const std::string& script,
                        const std::string& words) {
    folder_.write("a.obj", "");
    folder_.write("a.txt", "");
    folder_.write("script", script);
    shell.push_back("cd " + folder_.path().string() + "; source ./script; " + words);
    test::Finished run = test::run_program(shell, {"HOME=" + folder_.path().string()});
    EXPECT_EQ(run.err, "");
    std::ranges::replace(run.out, '\n', ' ');
    return run.out;
  }
  std::string bash(const std::string& words, int at) {
    return completed({"bash", "--norc", "-c"}, bash_completion(table()),
                     "COMP_WORDS=(" + words + "); COMP_CWORD=" + std::to_string(at) +
                         "; _mesher; echo \"${COMPREPLY[@]}\"");
  }
  std::string fish(const std::string& line) {
    return completed({"fish", "--no-config", "-c"}, fish_completion(table()),
                     "complete -C '" + line + "' | string split -f1 \\t");
  }

  test::TempFolder folder_;
};

TEST(CommandTable, HasKindsAndChoices) {
  EXPECT_EQ(table().commands.front().name, "view");
  const CommandInfo& simplify = command("simplify");
  EXPECT_EQ(option(simplify, "--cost").kind, ValueKind::choice);
  EXPECT_EQ(option(simplify, "--cost").choices.front(), "quadric");
  EXPECT_EQ(option(simplify, "--json").kind, ValueKind::none);
  EXPECT_EQ(option(simplify, "--faces").kind, ValueKind::text);
  EXPECT_EQ(option(simplify, "-o").kind, ValueKind::file);
  EXPECT_EQ(option(simplify, "--input").kind, ValueKind::model);
  ASSERT_EQ(simplify.positionals.size(), 2U);
  EXPECT_EQ(simplify.positionals[0].value_name, "MODEL");
  EXPECT_EQ(simplify.positionals[1].kind, ValueKind::file);
}

TEST(ManPage, ListsEveryArgument) {
  const auto dashes = [](std::string name) {
    for (std::size_t i = 0; (i = name.find('-', i)) != std::string::npos; i += 2)
      name.insert(i, 1, '\\');
    return name;
  };
  const std::string program = man_page(table(), "1.2.3");
  EXPECT_EQ(program.find(".TH MESHER 1 \"\" \"mesher 1.2.3\""), 0U);
  for (const CommandInfo& info : table().commands) {
    EXPECT_NE(program.find("mesher\\-" + info.name), std::string::npos);
    const std::string page = man_page(table(), info, "1.2.3");
    for (const ArgumentInfo& argument : info.options) {
      for (const std::string& name : argument.names)
        EXPECT_NE(page.find("\\fB" + dashes(name) + "\\fR"), std::string::npos) << name;
    }
  }
}

TEST_F(Completion, BashKnowsCommandsOptionsChoicesAndModels) {
  EXPECT_EQ(bash("mesher simp", 1), "simplify ");
  EXPECT_EQ(bash("mesher simplify --co", 2), "--cost --compress ");
  EXPECT_EQ(bash("mesher simplify --cost ac", 3), "accumulated ");
  EXPECT_EQ(bash("mesher a", 1), "a.obj ");
  EXPECT_EQ(bash("mesher info ''", 2), "a.obj ");
  EXPECT_EQ(bash("mesher simplify -o a", 3), "a.obj a.txt ");
  EXPECT_EQ(bash("mesher a.obj --scr", 2), "--screenshot ");
}

TEST_F(Completion, FishKnowsCommandsOptionsChoicesAndModels) {
  EXPECT_EQ(fish("mesher simp"), "simplify ");
  EXPECT_EQ(fish("mesher simplify --co"), "--compress --cost ");
  EXPECT_EQ(fish("mesher simplify --cost ac"), "accumulated ");
  EXPECT_EQ(fish("mesher info a"), "a.obj ");
}

// zsh completes only for a terminal.
TEST_F(Completion, ZshTakesTheScript) {
  const std::string script = zsh_completion(table());
  EXPECT_EQ(completed({"zsh", "-f", "-c"}, "_mesher_test() {\n" + script + "\n}\n", "echo read"),
            "read ");
  EXPECT_NE(script.find("--cost[which edge to collapse first"), std::string::npos);
}

}  // namespace
}  // namespace mesher::app
