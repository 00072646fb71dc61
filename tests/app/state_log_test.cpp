#include "app/state_log.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/core/error.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

TEST(StateLog, WritesALineOnlyWhenSomethingChanged) {
  const test::TempFolder folder;
  Session session;
  StateLog log(folder / "state");
  log.note(session);
  log.note(session);
  session.settings.wireframe = true;
  log.note(session);
  const std::string text = test::read_bytes(folder / "state");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
}

TEST(StateLog, RefusesAFolderThatIsNotThere) {
  EXPECT_THROW(StateLog("/no/such/folder/state"), OutputError);
}

}  // namespace
}  // namespace mesher::app
