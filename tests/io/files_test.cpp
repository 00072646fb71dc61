#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fcntl.h>
#include <chrono>
#include <string>
#include <thread>

#include "engine/core/error.h"
#include "engine/io/atomic_file.h"
#include "engine/io/mapped_file.h"
#include "engine/io/read.h"
#include "engine/io/write.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"
#include "tests/support/watched.h"

namespace mesher {
namespace {

using test::read_bytes;
using test::TempFolder;

TEST(MappedFile, HoldsTheBytesFollowedByZeros) {
  const TempFolder folder;
  for (const std::size_t size : {1U, 4095U, 4096U, 4097U, 100000U}) {
    std::string text(size, 'x');
    text[size / 2] = '\n';
    const io::MappedFile file(folder.write("f", text));
    EXPECT_EQ(file.bytes(), text);
    for (std::size_t i = 0; i < io::MappedFile::kPadding; ++i)
      EXPECT_EQ(file.end()[i], '\0');
    EXPECT_EQ(file.line_of(file.begin()), 1U);
    EXPECT_EQ(file.line_of(file.end()), 2U);
  }
}

TEST(MappedFile, EmptyFileHasSizeZero) {
  const TempFolder folder;
  EXPECT_EQ(io::MappedFile(folder.write("f", "")).size(), 0U);
}

TEST(MappedFile, ReadsPipes) {
  const TempFolder folder;
  const std::string pipe = (folder / "pipe").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string text(3 << 20, 'y');
  std::thread writer([&] {
    const int fd = open(pipe.c_str(), O_WRONLY);
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t n = write(fd, text.data() + done, text.size() - done);
      if (n <= 0) break;
      done += static_cast<std::size_t>(n);
    }
    close(fd);
  });
  const io::MappedFile file(pipe);
  writer.join();
  EXPECT_EQ(file.bytes(), text);
  EXPECT_EQ(file.end()[0], '\0');
}

TEST(MappedFile, WaitingForAPipeCanBeCanceled) {
  const TempFolder folder;
  const std::string pipe = (folder / "pipe").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  Progress progress;
  std::thread canceller([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    progress.cancel();
  });
  EXPECT_THROW(io::MappedFile(pipe, &progress), Cancelled);
  canceller.join();
}

TEST(MappedFile, ReadsFilesThatReportNoSize) {
  EXPECT_GT(io::MappedFile("/proc/self/status").size(), 0U);
}

TEST(MappedFile, RejectsPathsThatAreNotFiles) {
  const TempFolder folder;
  EXPECT_THROW(io::MappedFile(folder / "missing"), InputError);
  EXPECT_THROW(io::MappedFile{folder.path()}, InputError);
  EXPECT_THROW(io::MappedFile("/dev/zero"), InputError);
}

TEST(AtomicFile, AppearsOnCommit) {
  const TempFolder folder;
  io::AtomicFile file(folder / "out");
  file.write("hello ");
  file.write("world");
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  file.commit();
  EXPECT_EQ(read_bytes(folder / "out"), "hello world");
  EXPECT_EQ(folder.count_files(), 1U);
}

TEST(AtomicFile, WithoutCommitLeavesNoFile) {
  const TempFolder folder;
  folder.write("out", "old");
  {
    io::AtomicFile file(folder / "out");
    file.write("new");
  }
  EXPECT_EQ(read_bytes(folder / "out"), "old");
  EXPECT_EQ(folder.count_files(), 1U);
}

TEST(AtomicFile, FilesBesideAppearWithIt) {
  const TempFolder folder;
  {
    io::AtomicFile file(folder / "out");
    file.add_side("a/b/side").write("text");
    EXPECT_TRUE(std::filesystem::exists(folder / "a/b"));
  }
  EXPECT_EQ(folder.count_files(), 0U);
  io::AtomicFile file(folder / "out");
  file.add_side("a/b/side").write("text");
  file.add_side("other").write("more");
  EXPECT_FALSE(std::filesystem::exists(folder / "other"));
  file.commit();
  EXPECT_EQ(read_bytes(folder / "a/b/side"), "text");
  EXPECT_EQ(folder.count_files(), 3U);
  EXPECT_THROW(file.add_side("other/x"), OutputError);
}

TEST(AtomicFile, KeepsPermissionsAndFollowsLinks) {
  const TempFolder folder;
  folder.write("real", "old");
  ASSERT_EQ(chmod((folder / "real").c_str(), 0640), 0);
  std::filesystem::create_symlink("real", folder / "link");
  io::AtomicFile file(folder / "link");
  file.write("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(read_bytes(folder / "real"), "new");
  struct stat status = {};
  ASSERT_EQ(stat((folder / "real").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

TEST(AtomicFile, AcceptsTheLongestNames) {
  const TempFolder folder;
  const std::string name(255, 'n');
  io::AtomicFile file(folder / name);
  file.commit();
  EXPECT_TRUE(std::filesystem::exists(folder / name));
}

TEST(AtomicFile, RejectsFoldersAndMissingFolders) {
  const TempFolder folder;
  EXPECT_THROW(io::AtomicFile{folder.path()}, OutputError);
  EXPECT_THROW(io::AtomicFile(folder / "missing/out"), OutputError);
  EXPECT_EQ(folder.count_files(), 0U);
}

TEST(AtomicFile, CheckLeavesNoFile) {
  const TempFolder folder;
  EXPECT_NO_THROW(io::AtomicFile::check(folder / "new.txt"));
  EXPECT_NO_THROW(io::AtomicFile::check("new.txt"));
  EXPECT_NO_THROW(io::AtomicFile::check("/dev/null"));
  EXPECT_NO_THROW(io::AtomicFile::check(folder.write("old.txt", "old")));
  EXPECT_THROW(io::AtomicFile::check(folder.path()), OutputError);
  EXPECT_THROW(io::AtomicFile::check(folder / "no/such/folder/x"), OutputError);
  EXPECT_THROW(io::AtomicFile::check(folder / "old.txt/x"), OutputError);
  EXPECT_EQ(folder.count_files(), 1U);
  EXPECT_EQ(read_bytes(folder / "old.txt"), "old");
}

TEST(AtomicFile, ReportsFullDevice) {
  io::AtomicFile file("/dev/full");
  EXPECT_THROW(file.write("x"), OutputError);
  EXPECT_TRUE(std::filesystem::exists("/dev/full"));
}

TEST(AtomicFile, WritesDevicesDirectly) {
  io::AtomicFile file("/dev/null");
  file.write("x");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(ReadModel, HasOneProgressForEveryFormat) {
  const TempFolder folder;
  Soup soup = test::torus(600, 500);
  soup.attributes.normal.assign(soup.corners.size(), glm::vec3(0.0F, 0.0F, 1.0F));
  soup.attributes.color.assign(soup.corners.size(), glm::u8vec4(7));
  soup.attributes.texcoord.assign(soup.corners.size(), glm::vec2(0.5F));
  const BuildResult model = test::built(std::move(soup));
  for (const char* name : {"t.obj", "t.ply", "t.stl", "t.off", "t.gltf", "t.glb"}) {
    SCOPED_TRACE(name);
    io::write_model(folder / name, model.mesh, model.attributes);
    const auto read = [&](Progress* progress) {
      (void)io::read_model(folder / name, {.progress = progress});
    };
    test::expect_one_progress(test::watched(read), {"reading", "connecting", "building the mesh"});
    const auto write = [&](Progress* progress) {
      io::write_model(folder / name, model.mesh, model.attributes, {.progress = progress});
    };
    test::expect_one_progress(test::watched(write), {"writing"});
  }
}

}  // namespace
}  // namespace mesher
