#include "app/viewer/state_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "app/document/json.h"
#include "engine/core/error.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

TEST(StateLog, WritesLineOnlyOnChange) {
  const test::TempFolder folder;
  Session session;
  StateLog log(folder / "state");
  log.note(session);
  log.note(session);
  session.view.settings.wireframe = true;
  log.note(session);
  const std::string text = test::read_bytes(folder / "state");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
}

TEST(StateLog, ContainsPointerIfThereIsOne) {
  const test::TempFolder folder;
  const Session session;
  StateLog log(folder / "state");
  log.note(session);
  Pointer pointer{.at = {3.0, 4.5}};
  log.note(session, &pointer);
  pointer.is_pressed = true;
  log.note(session, &pointer);
  std::ifstream lines(folder / "state");
  std::string line;
  std::getline(lines, line);
  EXPECT_TRUE(Json::parse(line)["pointer"].is_null());
  std::getline(lines, line);
  EXPECT_EQ(Json::parse(line)["pointer"], (Json{{"at", {3.0, 4.5}}, {"pressed", false}}));
  std::getline(lines, line);
  EXPECT_EQ(Json::parse(line)["pointer"]["pressed"], true);
}

TEST(StateLog, MissingFolderThrows) {
  EXPECT_THROW(StateLog("/no/such/folder/state"), OutputError);
}

}  // namespace
}  // namespace mesher::app
