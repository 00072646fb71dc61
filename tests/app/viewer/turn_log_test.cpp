#include "app/viewer/turn_log.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "app/document/json.h"
#include "engine/core/error.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

std::vector<Json> turns_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<Json> turns;
  for (std::string line; std::getline(in, line);)
    turns.push_back(Json::parse(line));
  return turns;
}

TEST(TurnLog, WritesLinePerTurn) {
  const test::TempFolder folder;
  TurnLog log(folder / "turns");
  log.end(true, nullptr);  // no turn has begun
  log.begin();
  log.begin();  // a second event of the same turn
  log.begin_wait();
  log.end_wait();
  log.end(true, nullptr);
  log.begin();
  log.end(false, nullptr);
  const std::vector<Json> turns = turns_in(folder / "turns");
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_EQ(turns[0]["drew"], true);
  EXPECT_EQ(turns[1]["drew"], false);
  EXPECT_TRUE(turns[0]["job"].is_null());
  EXPECT_GE(turns[0]["own_ms"], 0.0);
  EXPECT_EQ(turns[1]["waited_ms"], 0.0);
  EXPECT_GE(turns[1]["end_s"], turns[0]["end_s"]);
}

TEST(TurnLog, NamesJobAndItsFraction) {
  const test::TempFolder folder;
  TurnLog log(folder / "turns");
  JobOf<int> job(
      "Counting",
      [](Progress& progress) {
        progress.set(0.5F);
        return 1;
      },
      nullptr);
  job.wait();
  log.begin();
  log.end(true, &job);
  const Json turn = turns_in(folder / "turns").at(0);
  EXPECT_EQ(turn["job"], "Counting");
  EXPECT_EQ(turn["fraction"], 1.0);
}

TEST(TurnLog, WithoutFileDoesNothing) {
  TurnLog log("");
  log.begin();
  log.end(true, nullptr);
  EXPECT_THROW(TurnLog("/no/such/folder/turns"), OutputError);
}

}  // namespace
}  // namespace mesher::app
