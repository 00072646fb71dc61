#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

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

TEST(MappedFile, NoticesEveryKindOfChange) {
  io::survive_cut_mappings();  // without it, files are copied, and do not change
  const TempFolder folder;
  const std::filesystem::path file = folder.write("f", "the old text");
  const auto change = [&](const char* what, const std::function<void()>& how) {
    const io::MappedFile mapped(folder.write("f", "the old text"));
    EXPECT_NO_THROW(mapped.check_unchanged());
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // longer than a tick
    how();
    EXPECT_THROW(mapped.check_unchanged(), io::InputChanged) << what;
  };
  change("rewritten at the same length", [&] { folder.write("f", "the new text"); });
  change("appended to", [&] { std::ofstream(file, std::ios::app) << "more"; });
  change("another file in its place",
         [&] { std::filesystem::rename(folder.write("g", "the old text"), file); });
  change("removed", [&] { std::filesystem::remove(file); });
  change("rewritten, and its time set back", [&] {
    const auto time = std::filesystem::last_write_time(file);
    folder.write("f", "the new text");
    std::filesystem::last_write_time(file, time);
  });
}

TEST(MappedFile, CopyKeepsItsBytes) {
  const TempFolder folder;
  const io::MappedFile copy(folder.write("f", "old"), nullptr, io::Keep::copied);
  folder.write("f", "new");
  EXPECT_EQ(copy.bytes(), "old");
  EXPECT_NO_THROW(copy.check_unchanged());
}

TEST(MappedFile, FileThatIsCutShortReadsAsZerosAndIsRefused) {
  io::survive_cut_mappings();
  const TempFolder folder;
  const std::size_t size = 100 * 4096;
  const std::filesystem::path file = folder.write("f", std::string(size, 'x'));
  const io::MappedFile mapped(file);
  const io::MappedFile other(folder.write("other", std::string(size, 'y')));
  std::filesystem::resize_file(file, 10 * 4096 + 100);
  EXPECT_EQ(mapped.begin()[10 * 4096 + 99], 'x');
  EXPECT_EQ(mapped.begin()[10 * 4096 + 100], '\0');
  EXPECT_EQ(std::count(mapped.begin(), mapped.end(), 'x'), 10 * 4096 + 100);
  EXPECT_EQ(mapped.end()[io::MappedFile::kPadding - 1], '\0');
  EXPECT_EQ(std::count(other.begin(), other.end(), 'y'), size);
  EXPECT_NO_THROW(other.check_unchanged());
  try {
    mapped.check_unchanged();
    ADD_FAILURE() << "is not noticed";
  } catch (const io::InputChanged& error) {
    EXPECT_NE(std::string(error.what()).find("cut short"), std::string::npos) << error.what();
  }
}

TEST(MappedFile, MoreFilesThanCanBeWatchedAreCopied) {
  io::survive_cut_mappings();
  const TempFolder folder;
  const std::filesystem::path file = folder.write("f", "text");
  std::vector<std::unique_ptr<io::MappedFile>> files;
  for (int i = 0; i < 1100; ++i) {
    files.push_back(std::make_unique<io::MappedFile>(file));
    EXPECT_EQ(files.back()->bytes(), "text");
  }
  EXPECT_EQ(files.front()->keep(), io::Keep::mapped);
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

TEST(AtomicFile, FollowsLinksThatLeadNowhere) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "there");
  std::filesystem::create_symlink("there/second", folder / "first");
  std::filesystem::create_symlink("real", folder / "there/second");
  EXPECT_NO_THROW(io::AtomicFile::check(folder / "first"));
  io::AtomicFile file(folder / "first");
  file.write("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "first"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "there/second"));
  EXPECT_EQ(read_bytes(folder / "there/real"), "new");
}

TEST(AtomicFile, RefusesCircularLinks) {
  const TempFolder folder;
  std::filesystem::create_symlink("b", folder / "a");
  std::filesystem::create_symlink("a", folder / "b");
  EXPECT_THROW(io::AtomicFile::check(folder / "a"), OutputError);
  EXPECT_THROW(io::AtomicFile(folder / "a"), OutputError);
}

TEST(AtomicFile, OtherHardLinksKeepTheOldContent) {
  const TempFolder folder;
  folder.write("out", "old");
  std::filesystem::create_hard_link(folder / "out", folder / "other");
  io::AtomicFile file(folder / "out");
  file.write("new");
  file.commit();
  EXPECT_EQ(read_bytes(folder / "out"), "new");
  EXPECT_EQ(read_bytes(folder / "other"), "old");
}

/// Runs `ask` in a process of an ordinary user, also if the superuser runs the test. Returns what
/// it returns.
bool as_ordinary_user(const std::function<bool()>& ask) {
  constexpr uid_t kNobody = 65534;
  const pid_t child = fork();
  if (child == 0) {
    const bool is_ordinary = geteuid() != 0 || (setgid(kNobody) == 0 && setuid(kNobody) == 0);
    _exit(is_ordinary && ask() ? 1 : 0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 1;
}

bool check_refuses(const std::filesystem::path& file) {
  try {
    io::AtomicFile::check(file);
    return false;
  } catch (const OutputError&) {
    return true;
  }
}

TEST(AtomicFile, CheckSeesFoldersThatCannotBeWritten) {
  const TempFolder folder;
  const std::filesystem::path file = folder.write("out", "old");
  std::filesystem::permissions(file, std::filesystem::perms(0666));
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0777));
  EXPECT_FALSE(as_ordinary_user([&] { return check_refuses(file); }));
  EXPECT_FALSE(as_ordinary_user([&] { return check_refuses(folder / "new"); }));
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0555));
  EXPECT_TRUE(as_ordinary_user([&] { return check_refuses(file); })) << "cannot be replaced";
  EXPECT_TRUE(as_ordinary_user([&] { return check_refuses(folder / "new"); }));
  if (geteuid() == 0) {
    // As in /tmp: everybody may write, but replace only what is his.
    std::filesystem::permissions(folder.path(), std::filesystem::perms(01777));
    EXPECT_TRUE(as_ordinary_user([&] { return check_refuses(file); }));
    EXPECT_FALSE(as_ordinary_user([&] { return check_refuses(folder / "new"); }));
  }
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0777));
}

TEST(AtomicFile, OwnerStaysIfItMayBeGiven) {
  const TempFolder folder;
  const std::filesystem::path file = folder.write("out", "old");
  // Only the superuser can give files away; anybody else's file has its own owner before and after.
  const uid_t owner = geteuid() == 0 ? 12345 : geteuid();
  const gid_t group = geteuid() == 0 ? 54321 : getegid();
  ASSERT_EQ(chown(file.c_str(), owner, group), 0);
  ASSERT_EQ(chmod(file.c_str(), 0604), 0);
  io::AtomicFile out(file);
  out.write("new");
  out.commit();
  struct stat status = {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_uid, owner);
  EXPECT_EQ(status.st_gid, group);
  EXPECT_EQ(status.st_mode & 07777U, 0604U);
}

TEST(AtomicFile, SeveralFilesAppearTogetherOrNotAtAll) {
  const TempFolder folder;
  std::vector<std::unique_ptr<io::AtomicFile>> files;
  for (const char* name : {"a", "b"}) {
    files.push_back(std::make_unique<io::AtomicFile>(folder / name));
    files.back()->write(name);
  }
  EXPECT_EQ(folder.count_files(), 0U);
  io::AtomicFile::commit_all(files);
  EXPECT_EQ(read_bytes(folder / "a"), "a");
  EXPECT_EQ(read_bytes(folder / "b"), "b");
  EXPECT_EQ(folder.count_files(), 2U);
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
