#include "app/files/journal.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include "app/files/load_job.h"
#include "app/files/restore.h"
#include "engine/io/read.h"
#include "tests/app/edit/editing.h"
#include "tests/support/small_disk.h"
#include "tests/support/temp_folder.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKnot = MESHER_SOURCE_DIR "/assets/knot.obj";

class JournalTest : public testing::Test {
 protected:
  fs::path journals() const { return folder_ / "state"; }
  /// The session of a process that will be lost.
  static Session opened(const fs::path& file) {
    Session session;
    show_model(session, io::read_model(file), file);
    session.document.source.stamp = stamp_of(file);
    return session;
  }
  std::size_t files() const {
    std::error_code none;
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(journals(), none), fs::directory_iterator()));
  }
  /// Leaves a journal of these keys behind, as a kill does.
  void lose(const fs::path& file, const char* keys) {
    Session session = opened(file);
    press(session, keys);
    Journal journal(journals());
    EXPECT_EQ(journal.note(session.document), "");
  }

  test::TempFolder folder_;
};

TEST_F(JournalTest, IsThereOnlyWhileEditsAreUnsaved) {
  Session s = opened(kKnot);
  Journal journal(journals());
  EXPECT_EQ(journal.note(s.document), "");
  EXPECT_EQ(files(), 0U);
  press(s, "d");
  EXPECT_EQ(journal.note(s.document), "");
  EXPECT_EQ(files(), 2U) << "the journal and its lock";
  press(s, "ctrl+z");
  EXPECT_EQ(journal.note(s.document), "");
  EXPECT_EQ(files(), 0U);
  press(s, "ctrl+y");
  EXPECT_EQ(journal.note(s.document), "");
  EXPECT_EQ(files(), 2U);
  journal.remove();
  EXPECT_EQ(files(), 0U);
}

TEST_F(JournalTest, OfARunningProcessIsNotLost) {
  Session s = opened(kKnot);
  press(s, "d");
  Journal journal(journals());
  journal.note(s.document);
  EXPECT_TRUE(lost_edits(journals()).empty());
}

TEST_F(JournalTest, HoldsEverythingThatRestoringNeeds) {
  Session s = opened(kKnot);
  s.document.source.crease_index_base = 1;
  s.document.source.tag_creases_deg = 12.5F;
  press(s, "d s d ctrl+z");
  Journal(journals()).note(s.document);
  const std::vector<LostEdits> lost = lost_edits(journals());
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost[0].problem, "");
  EXPECT_EQ(lost[0].file, kKnot);
  EXPECT_EQ(lost[0].source.stamp, stamp_of(kKnot));
  EXPECT_EQ(lost[0].source.crease_index_base, 1);
  EXPECT_EQ(lost[0].source.tag_creases_deg, 12.5F);
  EXPECT_EQ(lost[0].done, 2U);
  ASSERT_EQ(lost[0].texts.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(lost[0].texts[i], s.document.edits.history.steps()[i].text);
    EXPECT_EQ(lost[0].names[i], s.document.edits.history.steps()[i].name);
  }
  EXPECT_EQ(lost[0].ended.size(), std::string("2026-11-29 14:02").size());
  EXPECT_TRUE(lost_edits(journals()).empty()) << "one process at a time offers them";
}

TEST_F(JournalTest, RestoresTheModelAndTheUndoneEdits) {
  Session before = opened(kKnot);
  press(before, "d s shift+s d ctrl+z");
  Journal(journals()).note(before.document);
  LostEdits lost = std::move(lost_edits(journals()).at(0));
  LoadJob job(std::move(lost), nullptr);
  job.wait();
  LoadedModel loaded = job.take();
  Session after;
  show_model(after, std::move(loaded.model), loaded.statistics, loaded.file);
  after.document.source = loaded.source;
  request_lost_edits(after.document, *loaded.lost);
  loaded.lost.reset();
  Journal journal(journals());
  EXPECT_EQ(journal.note(after.document), "");
  EXPECT_EQ(files(), 2U) << "the lost journal stays until its edits are repeated";
  run_waiting_edits(after.document);
  EXPECT_EQ(after.document.error, "");
  EXPECT_TRUE(is_same(after.document.model.mesh, before.document.model.mesh));
  EXPECT_EQ(after.document.edits.history.undo_depth(), 3U);
  EXPECT_EQ(after.document.edits.history.redo_depth(), 1U);
  press(after, "ctrl+y");
  press(before, "ctrl+y");
  EXPECT_TRUE(is_same(after.document.model.mesh, before.document.model.mesh));
  EXPECT_EQ(journal.note(after.document), "");
  EXPECT_EQ(files(), 2U) << "a new journal has replaced the lost one";
}

TEST_F(JournalTest, ChangedOrMissingSourceIsAProblem) {
  const fs::path file = folder_.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  lose(file, "s");
  folder_.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 2 0\n3 0 1 2\n");
  EXPECT_NE(lost_edits(journals()).at(0).problem.find("has changed"), std::string::npos);
  fs::remove(file);
  EXPECT_NE(lost_edits(journals()).at(0).problem.find("cannot be read"), std::string::npos);
}

TEST_F(JournalTest, DamagedJournalsAreReportedAndCanBeDiscarded) {
  lose(kKnot, "d");
  fs::path journal;
  for (const auto& entry : fs::directory_iterator(journals()))
    if (entry.path().extension() == ".journal") journal = entry.path();
  const std::string whole = test::read_bytes(journal);
  std::vector<std::string> damaged{"",
                                   "{",
                                   "[]",
                                   "null",
                                   "{\"mesher_journal\":1}",
                                   "\xff\xfe",
                                   whole.substr(0, whole.size() / 2)};
  for (const char* key : {"source", "edits", "done", "crc32", "text", "file"}) {
    std::string other = whole;
    other.replace(other.find('"' + std::string(key) + '"') + 1, 1, "X");
    damaged.push_back(other);
  }
  for (const std::string& bytes : damaged) {
    folder_.write("state/" + journal.filename().string(), bytes);
    std::vector<LostEdits> lost = lost_edits(journals());
    ASSERT_EQ(lost.size(), 1U) << bytes;
    EXPECT_NE(lost[0].problem, "") << bytes;
  }
  discard(std::move(lost_edits(journals()).at(0)));
  EXPECT_EQ(files(), 0U);
}

TEST_F(JournalTest, DamagedEditTextRestoresNothing) {
  Session s = opened(kKnot);
  LostEdits lost;
  lost.texts = {"subdivide", "simplify_to faces=x"};
  request_lost_edits(s.document, lost);
  EXPECT_NE(s.document.error.find("is not a value of faces"), std::string::npos);
  EXPECT_TRUE(s.document.edits.waiting.empty());
}

TEST_F(JournalTest, FolderThatCannotBeWrittenIsSaidOnce) {
  const fs::path file = folder_.write("file", "");
  Session s = opened(kKnot);
  press(s, "d");
  Journal journal(file / "below");
  EXPECT_NE(journal.note(s.document).find("cannot be restored after a crash"), std::string::npos);
  press(s, "d");
  EXPECT_EQ(journal.note(s.document), "");
}

TEST_F(JournalTest, FullDiskIsSaidOnceAndKeepsTheEditsBefore) {
  const test::SmallDisk disk;
  Session s = opened(kKnot);
  Journal journal(disk.path());
  press(s, "d");
  EXPECT_EQ(journal.note(s.document), "");
  disk.fill();
  const auto kept = [&] {
    std::string text;
    for (const auto& entry : fs::directory_iterator(disk.path()))
      if (entry.path().extension() == ".journal") text = test::read_bytes(entry.path());
    return text;
  };
  const std::string before = kept();
  press(s, "d");
  const std::string remark = journal.note(s.document);
  EXPECT_TRUE(remark.starts_with("edits cannot be restored after a crash: ")) << remark;
  EXPECT_TRUE(remark.ends_with("No space left on device")) << remark;
  EXPECT_TRUE(journal.is_failing());
  press(s, "d");
  EXPECT_EQ(journal.note(s.document), "") << "not once per edit";
  EXPECT_EQ(kept(), before);
  EXPECT_EQ(disk.count_files(), 2U);
  disk.make_room();
  press(s, "d");
  EXPECT_EQ(journal.note(s.document), "edits can be restored after a crash again");
  EXPECT_FALSE(journal.is_failing());
  EXPECT_NE(kept(), before);
  EXPECT_EQ(journal.note(s.document), "");
  disk.fill();
  press(s, "d");
  EXPECT_NE(journal.note(s.document), "") << "it is another failure";
  journal.remove();
  EXPECT_EQ(disk.count_files(), 0U);
}

TEST_F(JournalTest, MissingHomeIsSaidOnce) {
  Session s = opened(kKnot);
  Journal journal{fs::path()};
  EXPECT_EQ(journal.note(s.document), "") << "there are no edits";
  press(s, "d");
  EXPECT_NE(journal.note(s.document).find("there is no home folder"), std::string::npos);
  press(s, "d");
  EXPECT_EQ(journal.note(s.document), "");
  EXPECT_FALSE(journal.has_edits());
}

TEST_F(JournalTest, FullDiskFromTheStartLeavesNothing) {
  const test::SmallDisk disk;
  disk.fill();
  Session s = opened(kKnot);
  press(s, "d");
  Journal journal(disk / "state");
  EXPECT_NE(journal.note(s.document), "");
  EXPECT_EQ(disk.count_files(), 0U);
  press(s, "ctrl+z");
  EXPECT_EQ(journal.note(s.document), "");
  EXPECT_FALSE(journal.is_failing()) << "nothing is unsaved";
  disk.make_room();
  press(s, "d");
  EXPECT_EQ(journal.note(s.document), "");
  EXPECT_EQ(disk.count_files(), 2U);
}

TEST_F(JournalTest, ReadingStampsCanBeCanceled) {
  lose(kKnot, "d");
  Progress progress;
  progress.cancel();
  EXPECT_THROW(lost_edits(journals(), &progress), Cancelled);
  EXPECT_EQ(lost_edits(journals()).size(), 1U) << "its lock is free";
}

TEST_F(JournalTest, ModelFromAPipeIsSaidOnce) {
  Session s = opened(kKnot);
  s.document.source.stamp.reset();
  press(s, "d");
  Journal journal(journals());
  EXPECT_NE(journal.note(s.document).find("cannot be read again"), std::string::npos);
  EXPECT_EQ(journal.note(s.document), "");
  EXPECT_EQ(files(), 0U);
}

TEST_F(JournalTest, FileNamesMayBeAnyBytes) {
  const std::string name = "a b%20\n\xff\xc3\xa4.off";
  const fs::path file = folder_.write(name, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  lose(file, "s");
  const std::vector<LostEdits> lost = lost_edits(journals());
  EXPECT_EQ(lost.at(0).file, file);
  EXPECT_EQ(lost.at(0).problem, "");
}

TEST_F(JournalTest, AnswersOfTheQuestion) {
  lose(kKnot, "d");
  Session s = opened(kKnot);
  for (LostEdits& lost : lost_edits(journals()))
    s.lost.push_back(std::move(lost));
  ASSERT_TRUE(has_question(s));
  answer_question(s, {.name = "r"});
  EXPECT_FALSE(has_question(s));
  ASSERT_EQ(s.wants_restore.size(), 1U);
  EXPECT_EQ(s.wants_restore.front().file, kKnot);
  s.lost = std::exchange(s.wants_restore, {});
  answer_question(s, {.name = "escape"});
  EXPECT_EQ(files(), 2U);
  s.lost.push_back(std::move(lost_edits(journals()).at(0)));
  answer_question(s, {.name = "d"});
  EXPECT_TRUE(has_question(s));
  answer_question(s, {.name = "delete"});
  EXPECT_EQ(files(), 0U);
}

TEST_F(JournalTest, StampSeesEveryByte) {
  const fs::path file = folder_.write("a", "abc");
  const auto stamp = stamp_of(file);
  ASSERT_TRUE(stamp);
  EXPECT_EQ(stamp->bytes, 3U);
  EXPECT_EQ(stamp->crc, 0x352441C2U);  // CRC-32 of "abc"
  EXPECT_FALSE(stamp_of(folder_ / "none"));
  EXPECT_FALSE(stamp_of(folder_.path()));
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_FALSE(stamp_of(folder_ / "pipe"));
}

}  // namespace
}  // namespace mesher::app
