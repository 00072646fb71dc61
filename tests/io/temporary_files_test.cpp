#include "engine/io/temporary_files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <set>
#include <string>

#include "engine/io/atomic_file.h"
#include "tests/support/temp_folder.h"

namespace mesher {
namespace {

using test::TempFolder;

/// A file that is open and locked like that of a living writer.
class LivingFile {
 public:
  explicit LivingFile(const std::filesystem::path& file)
      : descriptor_(open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600)) {
    EXPECT_TRUE(io::lock_temporary(descriptor_));
  }
  ~LivingFile() { close(descriptor_); }
  LivingFile(const LivingFile&) = delete;
  LivingFile& operator=(const LivingFile&) = delete;

 private:
  int descriptor_;
};

TEST(TemporaryFiles, NamesAreDifferent) {
  std::set<std::string> names;
  for (int i = 0; i < 1000; ++i)
    names.insert(io::temporary_name());
  EXPECT_EQ(names.size(), 1000U);
}

TEST(TemporaryFiles, NextWriteSweepsWhatDeadWritersLeft) {
  const TempFolder folder;
  const std::string dead = io::temporary_name();
  const std::string living = io::temporary_name();
  const std::string pipe = io::temporary_name();
  folder.write(dead, "half a model");
  folder.write(".mesher-my-notes-of-2024.tmp", "of somebody else");
  folder.write("x" + io::temporary_name(), "of somebody else");
  ASSERT_EQ(mkfifo((folder / pipe).c_str(), 0600), 0);
  const LivingFile lock(folder / living);
  io::AtomicFile file(folder / "out");
  EXPECT_FALSE(std::filesystem::exists(folder / dead));
  EXPECT_TRUE(std::filesystem::exists(folder / living));
  EXPECT_TRUE(std::filesystem::exists(folder / pipe));
  EXPECT_EQ(folder.count_files(), 4U) << "those of somebody else stay as well";
}

TEST(TemporaryFiles, FileIsLockedUntilItHasItsName) {
  const TempFolder folder;
  const std::string name = io::temporary_name();
  const LivingFile lock(folder / name);
  const int other = open((folder / name).c_str(), O_WRONLY | O_CLOEXEC);
  EXPECT_FALSE(io::lock_temporary(other));
  close(other);
}

TEST(TemporaryFiles, NestedTimesWithoutSignalsEndTogether) {
  const auto blocks_term = [] {
    sigset_t now;
    pthread_sigmask(SIG_SETMASK, nullptr, &now);
    return sigismember(&now, SIGTERM) == 1;
  };
  EXPECT_FALSE(blocks_term());
  {
    const io::NoSignals outer;
    {
      const io::NoSignals inner;
      EXPECT_TRUE(blocks_term());
    }
    EXPECT_TRUE(blocks_term());
  }
  EXPECT_FALSE(blocks_term());
}

}  // namespace
}  // namespace mesher
