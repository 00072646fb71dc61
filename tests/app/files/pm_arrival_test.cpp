#include "app/files/pm_arrival.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "app/document/shown.h"
#include "app/edit/edits.h"
#include "app/edit/progressive_edits.h"
#include "app/input/commands.h"
#include "engine/core/error.h"
#include "engine/io/pm_file.h"
#include "engine/progressive/build.h"
#include "engine/progressive/codec/pm_write.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

using Bytes = std::vector<std::byte>;

class PmArrivalTest : public testing::Test {
 protected:
  PmArrivalTest() {
    progressive::Progressive progressive =
        progressive::make_progressive(build_mesh(test::torus(120, 80)).mesh, {.target_faces = 200});
    mesh_ = std::move(progressive.mesh);
    progressive::write_pm(mesh_, {}, [&](std::span<const std::byte> piece) {
      bytes_.insert(bytes_.end(), piece.begin(), piece.end());
    });
    mesh_.go_to(mesh_.split_count());
    Model model;
    model.mesh = build_mesh(test::cube()).mesh;
    show_model(session_, std::move(model), "cube.obj");
  }

  std::filesystem::path file_of(std::span<const std::byte> bytes, const char* name = "torus.pm") {
    const std::filesystem::path file = folder_ / name;
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    return file;
  }
  /// Makes a named pipe that is open for writing until `close`.
  std::filesystem::path pipe() {
    const std::filesystem::path file = folder_ / "pipe";
    EXPECT_EQ(mkfifo(file.c_str(), 0600), 0);
    pipe_ = ::open(file.c_str(), O_RDWR);
    return file;
  }
  void put(std::size_t begin, std::size_t end) {
    EXPECT_EQ(::write(pipe_, bytes_.data() + begin, end - begin), ssize_t(end - begin));
  }
  /// Returns when all bytes are read or fit into the buffer of the pipe.
  void put(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const ssize_t count = ::write(pipe_, bytes.data(), bytes.size());
      ASSERT_GT(count, 0);
      bytes = bytes.subspan(std::size_t(count));
    }
  }
  void close() { ::close(pipe_); }
  /// Advances until `is_enough` returns true.
  void advance(PmArrival& arrival, const auto& is_enough) {
    for (int i = 0; i < 5000 && !is_enough(); ++i) {
      arrival.advance(session_, 0.01);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_TRUE(is_enough());
  }
  ProgressiveView& view() { return session_.document.progressive; }

  test::TempFolder folder_;
  progressive::ProgressiveMesh mesh_;
  Bytes bytes_;
  int pipe_ = -1;
  Session session_;
};

TEST_F(PmArrivalTest, DetectsProgressiveMeshFiles) {
  EXPECT_TRUE(io::is_pm_file("model.pm"));
  EXPECT_TRUE(io::is_pm_file("MODEL.PM"));
  EXPECT_FALSE(io::is_pm_file("model.obj"));
  EXPECT_FALSE(io::is_pm_file("no such file"));
  EXPECT_TRUE(io::is_pm_file(file_of(bytes_, "without ending")));
  EXPECT_FALSE(io::is_pm_file(file_of(std::span(bytes_).first(4), "short")));
  EXPECT_TRUE(io::is_pm_file(pipe()));
  close();
  EXPECT_THROW(PmArrival("no such file.pm"), InputError);
}

TEST_F(PmArrivalTest, FileBecomesModelInProgressiveMode) {
  PmArrival arrival(file_of(bytes_));
  arrival.finish(session_);
  EXPECT_TRUE(arrival.is_done());
  EXPECT_TRUE(view().is_on());
  EXPECT_FALSE(view().is_arriving());
  EXPECT_TRUE(difference(session_.document.model.mesh, mesh_.mesh()).is_empty());
  EXPECT_EQ(session_.document.model.name, "torus.pm");
  EXPECT_EQ(session_.document.statistics.faces, 19'200U);
  EXPECT_EQ(session_.document.edits.opened_faces, 19'200U);
  EXPECT_EQ(session_.document.error, "");
  EXPECT_FALSE(view().has_geomorph());
  run_waiting_edits(session_.document);
  EXPECT_TRUE(view().has_geomorph());
  EXPECT_TRUE(view().is_at_end());
  run(session_, "least_detail");
  EXPECT_EQ(shown_mesh(session_.document).face_count(), mesh_.base_face_count());
  run(session_, "keep_level");
  run_waiting_edits(session_.document);
  EXPECT_EQ(session_.document.statistics.faces, mesh_.base_face_count());
  run(session_, "undo");
  run_waiting_edits(session_.document);
  EXPECT_EQ(session_.document.statistics.faces, 19'200U);
}

TEST_F(PmArrivalTest, AttributesAreThereOnceTheFileIsRead) {
  const Mesh full = build_mesh(test::torus(60, 40)).mesh;
  CornerAttributes corners;
  for (std::uint32_t h = 0; h < full.halfedge_count(); ++h)
    corners.texcoord.push_back({0.25F * full.position(full.origin(Halfedge(h))).x, 0.5F});
  progressive::Progressive made = progressive::make_progressive(
      full, to_wedges(full, std::move(corners)), {.target_faces = 200});
  Bytes bytes;
  progressive::write_pm(made.mesh, {.attributes = &made.attributes},
                        [&](std::span<const std::byte> piece) {
                          bytes.insert(bytes.end(), piece.begin(), piece.end());
                        });
  PmArrival arrival(file_of(bytes));
  arrival.finish(session_);
  run_waiting_edits(session_.document);
  const auto expect_texture = [](const Shape& shape) {
    const auto corners_of_shape = to_corners(shape.mesh, shape.attributes);
    ASSERT_EQ(corners_of_shape.texcoord.size(), shape.mesh.halfedge_count());
    for (std::uint32_t h = 0; h < shape.mesh.halfedge_count(); ++h) {
      const float x = shape.mesh.position(shape.mesh.origin(Halfedge(h))).x;
      ASSERT_NEAR(corners_of_shape.texcoord[h].x, 0.25F * x, 0.1F);
    }
  };
  expect_texture({session_.document.model.mesh, session_.document.model.attributes});
  run(session_, "least_detail");
  ASSERT_LT(shown_mesh(session_.document).face_count(), 300U);
  expect_texture(shown_shape(session_.document));
  run(session_, "keep_level");
  run_waiting_edits(session_.document);
  expect_texture({session_.document.model.mesh, session_.document.model.attributes});
}

TEST_F(PmArrivalTest, PipeIsShownWhileItLoads) {
  const std::size_t most = bytes_.size() - bytes_.size() / 20;  // all but the last block
  PmArrival arrival(pipe());
  put(0, bytes_.size() / 4);
  arrival.wait_for_base(session_, 60.0);
  EXPECT_TRUE(view().is_on());
  EXPECT_TRUE(view().is_arriving());
  EXPECT_GE(session_.document.statistics.faces, mesh_.base_face_count());
  put(bytes_.size() / 4, bytes_.size() / 2);
  advance(arrival, [&] { return view().mesh().split_count() > 0; });
  EXPECT_TRUE(view().is_at_end()) << "follows the loaded splits";
  EXPECT_EQ(view().mesh().level(), view().mesh().split_count());
  // While the file loads, the mode cannot be left and the level cannot be used as the model.
  run(session_, "toggle_progressive");
  EXPECT_TRUE(view().is_on());
  run(session_, "keep_level");
  EXPECT_NE(session_.document.notice.find("still loading"), std::string::npos);
  // After the level was changed by hand, new splits no longer change it.
  run(session_, "least_detail");
  run(session_, "one_split_up");
  const std::uint32_t splits = view().mesh().split_count();
  put(bytes_.size() / 2, most);
  advance(arrival, [&] { return view().mesh().split_count() > splits; });
  EXPECT_EQ(view().mesh().level(), 1U);
  put(most, bytes_.size());
  close();
  arrival.finish(session_);
  EXPECT_EQ(view().mesh().level(), 1U);
  EXPECT_TRUE(difference(session_.document.model.mesh, mesh_.mesh()).is_empty());
  run_waiting_edits(session_.document);
  EXPECT_TRUE(view().has_geomorph());
  EXPECT_NEAR(view().range().grown(view().time()), 1.0, 1e-6);
}

TEST_F(PmArrivalTest, TruncatedFileIsShownWithError) {
  PmArrival arrival(file_of(std::span(bytes_).first(bytes_.size() / 2)));
  arrival.finish(session_);
  EXPECT_GT(session_.document.statistics.faces, mesh_.base_face_count());
  EXPECT_LT(session_.document.statistics.faces, 19'200U);
  EXPECT_NE(session_.document.error.find("torus.pm"), std::string::npos) << session_.document.error;
  run_waiting_edits(session_.document);
  EXPECT_TRUE(view().has_geomorph());
  test::expect_valid(session_.document.model.mesh);
}

TEST_F(PmArrivalTest, MissingBaseKeepsShownModel) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{20}}) {
    PmArrival cut(file_of(std::span(bytes_).first(size)));
    EXPECT_THROW(cut.finish(session_), InputError) << size;
  }
  Bytes garbage(100'000, std::byte{0x5A});
  PmArrival arrival(file_of(garbage));
  EXPECT_THROW(arrival.finish(session_), InputError);
  EXPECT_EQ(session_.document.statistics.faces, 12U);
  EXPECT_FALSE(view().has_mesh());
}

TEST_F(PmArrivalTest, ReadingEndsAfterLastSplitOrDamage) {
  for (const bool is_damaged : {false, true}) {
    Bytes endless = bytes_;
    if (is_damaged) endless[bytes_.size() / 2] ^= std::byte{0x10};
    endless.resize(bytes_.size() + 30'000);
    PmArrival arrival(pipe());  // the pipe stays open, so it has no end
    put(endless);
    arrival.finish(session_);
    EXPECT_TRUE(arrival.is_done());
    const std::string& error = session_.document.error;
    EXPECT_EQ(error.find("splits were read") != std::string::npos, is_damaged) << error;
    EXPECT_EQ(error.empty(), !is_damaged) << error;
    EXPECT_EQ(session_.document.statistics.faces == 19'200U, !is_damaged);
    close();
    std::filesystem::remove(folder_ / "pipe");
  }
}

TEST_F(PmArrivalTest, ReadingBelowFullDetailUsesLargerSteps) {
  const auto bites = [&](bool follows) {
    PmArrival arrival(file_of(bytes_));
    arrival.wait_for_base(session_, 60.0);
    if (!follows) view().move_to(0.0);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // the whole file is buffered now
    int count = 0;
    for (int i = 0; i < 5000 && !arrival.is_done(); ++i) {
      if (arrival.advance(session_, 0.0)) ++count;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_TRUE(arrival.is_done());
    return count;
  };
  EXPECT_GE(bites(true), 3) << "each call reads one block, as it has no time";
  EXPECT_LE(bites(false), 2) << "each goes to full detail and back";
}

TEST_F(PmArrivalTest, PipeWithoutWriterDoesNotBlock) {
  const std::filesystem::path file = folder_ / "pipe";
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  PmArrival arrival(file);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_FALSE(arrival.has_news(session_.document.progressive))
      << "no writer does not mean end of file";
  pipe_ = ::open(file.c_str(), O_WRONLY);
  std::thread writer([this] {
    put(bytes_);
    close();
  });
  arrival.finish(session_);
  writer.join();
  EXPECT_EQ(session_.document.statistics.faces, 19'200U);
  EXPECT_EQ(session_.document.error, "");
}

TEST_F(PmArrivalTest, StopKeepsLoadedPart) {
  PmArrival arrival(pipe());
  put(0, bytes_.size() / 2);
  advance(arrival, [&] { return view().has_mesh() && view().mesh().split_count() > 0; });
  const std::uint32_t faces = view().mesh().full_face_count();
  arrival.stop(session_.document);
  EXPECT_TRUE(arrival.is_done());
  EXPECT_FALSE(view().is_arriving());
  EXPECT_EQ(session_.document.statistics.faces, faces);
  EXPECT_FALSE(arrival.advance(session_, 0.1));
  close();
}

TEST_F(PmArrivalTest, SilentPipeDoesNotBlock) {
  const auto begin = std::chrono::steady_clock::now();
  {
    PmArrival arrival(pipe());
    EXPECT_FALSE(arrival.advance(session_, 1.0));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
  close();
}

TEST_F(PmArrivalTest, StreamLargerThanReadAheadIsReadCompletely) {
  Bytes large(3 * io::ByteStream::kMostAhead, std::byte{1});
  io::ByteStream stream(file_of(large, "large"));
  stream.wait();
  std::size_t taken = 0;
  while (!stream.is_at_end()) {
    stream.wait();
    taken += stream.take().size();
  }
  EXPECT_EQ(taken, large.size());
  EXPECT_EQ(stream.failure(), "");
}

}  // namespace
}  // namespace mesher::app
