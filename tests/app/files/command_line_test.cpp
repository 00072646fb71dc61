#include "app/files/command_line.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "app/cli/options.h"
#include "app/cli/view.h"
#include "app/edit/crease_edits.h"
#include "app/edit/edit_text.h"
#include "app/edit/edits.h"
#include "app/files/save.h"
#include "app/input/commands.h"
#include "tests/support/process.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

class CommandLineText : public testing::Test {
 protected:
  void open(const std::string& asset, const std::string& name) {
    fs::copy_file(fs::path(MESHER_SOURCE_DIR) / "assets" / asset, folder_ / name);
    open_whole(session_, {.model = (folder_ / name).string()}, {.quiet = true});
  }
  void press(const char* keys) {
    for (const KeyPress& key : parse_keys(keys)) {
      run(session_, *command_for(key));
      run_waiting_edits(session_.document);
    }
  }
  /// Saves the shown model, and runs what is copied. Both files must have the same bytes.
  void expect_same_bytes() {
    const std::string line = command_line(session_.document);
    const fs::path written = suggested_file(session_.document);
    const fs::path saved = folder_ / ("saved" + written.extension().string());
    session_.saving.waiting = saved;
    perform(*begin_save(session_.saving, session_.document));
    const std::string program = fs::path(MESHER_PROGRAM).parent_path().string();
    const auto ran = test::run_program({"sh", "-c", "PATH=" + program + ":$PATH; " + line});
    ASSERT_EQ(ran.exit_code, 0) << line << "\n" << ran.err;
    EXPECT_TRUE(test::read_bytes(written) == test::read_bytes(saved)) << line;
    EXPECT_GT(fs::file_size(saved), 0U);
    fs::remove(written);
    fs::remove(saved);
  }

  test::TempFolder folder_;
  Session session_;
};

TEST_F(CommandLineText, EveryEditOfTheCommandTableCanBeCopied) {
  open("knot.obj", "knot.obj");
  std::set<std::string> missing;
  for (const EditKind& kind : edit_kinds())
    missing.insert(kind.name);
  const auto copy_and_run = [&] {
    for (const HistoryStep& step : session_.document.edits.history.steps())
      missing.erase(step.text.substr(0, step.text.find(' ')));
    expect_same_bytes();
  };
  request_simplify_to(session_.document, 2000);
  run_waiting_edits(session_.document);
  copy_and_run();
  request_crease_edit(session_.document,
                      {.kind = CreaseRequest::Kind::tag_by_angle, .value = 9.0F});
  run_waiting_edits(session_.document);
  for (const char* keys : {"ctrl+a", "-", "i", "x", "ctrl+z", "d", "shift+d", "s", "s", "l",
                           "shift+s", "p", "[", "[", "k", "ctrl+z"}) {
    SCOPED_TRACE(keys);
    press(keys);
    // In progressive mode, the level that is shown is not the model.
    if (!session_.document.progressive.is_on()) copy_and_run();
  }
  request_crease_edit(session_.document, {.kind = CreaseRequest::Kind::clear_all});
  run_waiting_edits(session_.document);
  copy_and_run();
  EXPECT_TRUE(missing.empty()) << "not shown for " << *missing.begin();
}

TEST_F(CommandLineText, NamesAreQuotedForTheShell) {
  open("cube.obj", "it's a \"cube\" $HOME;.obj");
  press("d");
  expect_same_bytes();
}

TEST_F(CommandLineText, ReadingOptionsAreRepeated) {
  fs::copy_file(fs::path(MESHER_SOURCE_DIR) / "assets/cube.obj", folder_ / "c.obj");
  open_whole(session_, {.model = (folder_ / "c.obj").string(), .tag_creases_deg = 40.5F},
             {.quiet = true});
  press("s");
  EXPECT_NE(command_line(session_.document).find(" --tag-creases 40.5 "), std::string::npos);
  expect_same_bytes();
}

TEST_F(CommandLineText, NothingToCopyIsSaid) {
  open("cube.obj", "c.obj");
  const Command& copy = *command_named("copy_command_line");
  EXPECT_EQ(blocked(session_, copy), std::string("there are no edits to copy"));
  press("d");
  EXPECT_EQ(blocked(session_, copy), nullptr);
  run(session_, copy);
  EXPECT_EQ(session_.copied, command_line(session_.document));
}

}  // namespace
}  // namespace mesher::app
