#include "app/files/arrival_runner.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "app/document/tabs.h"
#include "app/edit/crease_edits.h"
#include "app/edit/edits.h"
#include "app/input/commands.h"
#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/progressive/build.h"
#include "engine/progressive/codec/pm_write.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

class ArrivalRunnerTest : public testing::Test {
 protected:
  ArrivalRunnerTest() {
    Model model;
    model.mesh = build_mesh(test::cube()).mesh;
    show_model(session_, std::move(model), "cube.obj");
  }
  std::filesystem::path torus_file(std::uint32_t around = 40, std::uint32_t across = 30) {
    progressive::Progressive progressive = progressive::make_progressive(
        build_mesh(test::torus(around, across)).mesh, {.target_faces = 100});
    std::string bytes;
    progressive::write_pm(progressive.mesh, {}, [&](std::span<const std::byte> piece) {
      bytes.append(reinterpret_cast<const char*>(piece.data()), piece.size());
    });
    return file_of(bytes, "torus.pm");
  }
  std::filesystem::path file_of(const std::string& bytes, const char* name) {
    const std::filesystem::path file = folder_ / name;
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }
  void arrive() {
    for (int i = 0; i < 5000 && arrivals_.is_running(); ++i) {
      arrivals_.advance(0.01);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_FALSE(arrivals_.is_running());
  }
  ProgressiveView& view() { return session_.document.progressive; }

  test::TempFolder folder_;
  Session session_;
  EditRunner edits_{session_.document, nullptr};
  ArrivalRunner arrivals_{session_, edits_, nullptr};
};

TEST_F(ArrivalRunnerTest, FailedOpenKeepsRunningEdits) {
  arrivals_.open(torus_file());
  arrive();
  EXPECT_EQ(edits_.job(), nullptr);
  edits_.advance();
  ASSERT_TRUE(edits_.is_running()) << "geomorphs";
  EXPECT_THROW(arrivals_.open("no such file.pm"), InputError);
  arrivals_.open(file_of("no mesh at all", "wrong.pm"));
  edits_.finish();
  arrive();
  EXPECT_NE(session_.document.error.find("wrong.pm"), std::string::npos) << session_.document.error;
  edits_.finish();
  EXPECT_TRUE(view().has_geomorph());
  EXPECT_EQ(session_.document.statistics.faces, 2400U);
}

TEST_F(ArrivalRunnerTest, BaseWaitsForEditsAndGetsATab) {
  request_collapse_edge(session_.document);
  edits_.advance();
  ASSERT_TRUE(edits_.is_running());
  arrivals_.open(torus_file());
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE(arrivals_.has_news()) << "the window would not sleep";
    arrivals_.advance(0.01);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_TRUE(edits_.is_running());
  EXPECT_EQ(tab_count(session_), 1U);
  edits_.finish();
  EXPECT_EQ(session_.document.statistics.faces, 10U);
  arrive();
  edits_.finish();
  EXPECT_EQ(session_.document.statistics.faces, 2400U);
  EXPECT_EQ(session_.document.edits.history.undo_depth(), 0U);
  EXPECT_TRUE(view().has_geomorph()) << "requested after the last split";
  ASSERT_EQ(tab_count(session_), 2U);
  EXPECT_EQ(document_of(session_, 0).edits.history.undo_depth(), 1U) << "the edit is kept";
}

TEST_F(ArrivalRunnerTest, OutOfMemoryKeepsBase) {
  arrivals_.open(torus_file(120, 80));
  for (int i = 0; i < 5000 && !view().has_mesh(); ++i) {
    arrivals_.advance(0.0);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_TRUE(arrivals_.is_running()) << "each call reads one block";
  {
    const MemoryLimit limit(1);
    EXPECT_NO_THROW(arrivals_.stop());
  }
  EXPECT_FALSE(arrivals_.is_running());
  EXPECT_FALSE(view().has_mesh());
  EXPECT_FALSE(view().is_on());
  EXPECT_NE(session_.document.error, "");
  test::expect_valid(session_.document.model.mesh);
  EXPECT_EQ(session_.document.statistics.faces, session_.document.model.mesh.face_count());
}

TEST_F(ArrivalRunnerTest, FinishedGeomorphsDoNotReenterMode) {
  arrivals_.open(torus_file());
  arrive();
  edits_.advance();
  ASSERT_TRUE(edits_.is_running());
  run(session_, "toggle_progressive");
  set_crease_mode(session_.document, true);
  edits_.finish();
  EXPECT_FALSE(view().is_on());
  EXPECT_TRUE(session_.document.creases.is_on);
  EXPECT_TRUE(view().has_geomorph()) << "kept for the next time";
}

TEST_F(ArrivalRunnerTest, CreaseModeStaysOnWhileMeshIsBuilt) {
  set_crease_mode(session_.document, true);
  run(session_, "toggle_progressive");
  EXPECT_FALSE(session_.document.creases.is_on);
  edits_.advance();
  set_crease_mode(session_.document, true);
  edits_.finish();
  EXPECT_TRUE(view().has_mesh());
  EXPECT_FALSE(view().is_on());
  EXPECT_TRUE(session_.document.creases.is_on);
}

TEST_F(ArrivalRunnerTest, CanceledGeomorphsAreRequestedAgain) {
  arrivals_.open(torus_file());
  arrive();
  edits_.advance();
  edits_.cancel();
  edits_.finish();
  EXPECT_FALSE(view().has_geomorph());
  run(session_, "toggle_progressive");
  run(session_, "toggle_progressive");
  edits_.finish();
  EXPECT_TRUE(view().is_on());
  EXPECT_TRUE(view().has_geomorph());
}

}  // namespace
}  // namespace mesher::app
