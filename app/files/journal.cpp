#include "app/files/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

#include "app/document/json.h"
#include "app/files/paths.h"
#include "app/files/percent.h"
#include "engine/core/error.h"
#include "engine/io/atomic_file.h"
#include "engine/io/mapped_file.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

constexpr int kVersion = 2;
constexpr const char* kExtension = ".journal";
constexpr const char* kLockExtension = ".lock";
// Between looks whether the work is canceled.
constexpr std::size_t kCrcBlock = std::size_t{1} << 24;

fs::path lock_of(const fs::path& journal) {
  return fs::path(journal).replace_extension(kLockExtension);
}

template <class T>
Json optional_json(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

template <class T>
std::optional<T> optional_of(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional<T>(json.get<T>());
}

Json source_json(const fs::path& file, const ModelSource& source) {
  return {{"file", percent_encoded(fs::absolute(file).string())},
          {"bytes", source.stamp->bytes},
          {"crc32", source.stamp->crc},
          {"crease_index_base", optional_json(source.crease_index_base)},
          {"keep_isolated", source.keep_isolated_vertices},
          {"weld", optional_json(source.weld)},
          {"tag_creases_deg", optional_json(source.tag_creases_deg)}};
}

std::string journal_text(const Document& document) {
  const History& history = document.edits.history;
  Json edits = Json::array();
  for (const HistoryStep& step : history.steps())
    edits.push_back({{"name", step.name}, {"text", step.text}});
  return to_text({{"mesher_journal", kVersion},
                  {"source", source_json(document.file, document.source)},
                  {"done", history.done_steps()},
                  {"edits", std::move(edits)}});
}

void read_source(const Json& json, LostEdits& lost) {
  lost.file = percent_decoded(json.at("file").get<std::string>());
  lost.source.stamp = {json.at("bytes").get<std::uint64_t>(),
                       json.at("crc32").get<std::uint32_t>()};
  lost.source.crease_index_base = optional_of<int>(json.at("crease_index_base"));
  lost.source.keep_isolated_vertices = json.at("keep_isolated").get<bool>();
  lost.source.weld = optional_of<double>(json.at("weld"));
  lost.source.tag_creases_deg = optional_of<float>(json.at("tag_creases_deg"));
}

void read_journal(LostEdits& lost) {
  const io::MappedFile bytes(lost.journal);
  const Json json = Json::parse(bytes.bytes());
  if (json.at("mesher_journal").get<int>() != kVersion)
    throw InputError(lost.journal.string(), 0, "was written by another version of mesher");
  read_source(json.at("source"), lost);
  for (const Json& edit : json.at("edits")) {
    lost.names.push_back(edit.at("name").get<std::string>());
    lost.texts.push_back(edit.at("text").get<std::string>());
  }
  lost.done = std::min(json.at("done").get<std::size_t>(), lost.texts.size());
}

/// Why the edits cannot be repeated; empty if they can.
std::string problem_of(const LostEdits& lost, Progress* progress) {
  const auto stamp = stamp_of(lost.file, progress);
  if (!stamp) return lost.file.string() + " cannot be read any more";
  if (stamp != lost.source.stamp) return lost.file.string() + " has changed since";
  return "";
}

}  // namespace

std::unique_ptr<FileLock> FileLock::try_lock(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor < 0) return nullptr;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor);
    return nullptr;
  }
  return std::unique_ptr<FileLock>(new FileLock(descriptor));
}

FileLock::~FileLock() {
  ::close(descriptor_);
}

std::vector<LostEdits> lost_edits(const fs::path& folder, Progress* progress) {
  std::vector<LostEdits> result;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    if (entry.path().extension() != kExtension) continue;
    LostEdits lost;
    lost.journal = entry.path();
    lost.lock = FileLock::try_lock(lock_of(entry.path()));
    if (!lost.lock) continue;  // its process is running
    std::error_code ignored;
    lost.ended = time_text(fs::last_write_time(entry.path(), ignored));
    try {
      read_journal(lost);
      lost.problem = problem_of(lost, progress);
    } catch (const Cancelled&) {
      throw;
    } catch (const std::exception& error) {
      lost.texts.clear();
      lost.problem = entry.path().string() + " is damaged: " + error.what();
    }
    result.push_back(std::move(lost));
  }
  std::ranges::sort(result, {}, &LostEdits::ended);
  return result;
}

std::string Journal::note(Document& document) {
  if (refused_opening_ == document.opening) return "";
  // Lost edits are not repeated yet.
  if (!document.edits.waiting.empty() || document.edits.is_changing) return "";
  const History& history = document.edits.history;
  const Noted now{document.opening, history.state(), history.steps().size()};
  if (is_up_to_date(document, now)) return "";
  std::string remark;
  if (history.state() == document.edits.saved_state) {
    remove();
  } else if (folder_.empty() || !document.source.stamp) {
    refused_opening_ = document.opening;
    return std::string("these edits cannot be restored after a crash, because ") +
           (folder_.empty() ? "there is no home folder (set HOME or XDG_STATE_HOME)"
                            : "the model cannot be read again");
  } else {
    remark = write_noted(document, now);
    if (is_failing()) return remark;
  }
  std::optional<LostEdits>& restored = document.edits.restored;
  if (restored && history.steps().size() >= restored->texts.size()) {
    discard(std::move(*restored));
    restored.reset();
  }
  return remark;
}

bool Journal::is_up_to_date(const Document& document, const Noted& now) const {
  if (now.state == document.edits.saved_state)
    return !noted_ && !failure_ && !document.edits.restored;
  // On a full disk, the window must not write in every frame.
  const std::chrono::duration<double> pause(kRetrySeconds);
  if (failure_ && failure_->tried == now)
    return std::chrono::steady_clock::now() - failure_->when < pause;
  return noted_ == now;
}

/// The journal of earlier edits stays if the new one cannot be written.
std::string Journal::write_noted(const Document& document, const Noted& now) {
  const bool was_failing = is_failing();
  try {
    write(document);
    noted_ = now;
    failure_.reset();
    return was_failing ? "edits can be restored after a crash again" : "";
  } catch (const std::exception& error) {
    if (!noted_) remove();
    failure_ = Failure{now, std::chrono::steady_clock::now()};
    return was_failing ? ""
                       : std::string("edits cannot be restored after a crash: ") + error.what();
  }
}

void Journal::open() {
  make_folder(folder_);
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  file_ = folder_ / fmt::format("{}-{}{}", ::getpid(), now, kExtension);
  lock_ = FileLock::try_lock(lock_of(file_));
  if (!lock_) {
    throw OutputError(lock_of(file_).string(),
                      "cannot write: " + std::generic_category().message(errno));
  }
}

void Journal::write(const Document& document) {
  if (file_.empty()) open();
  const std::string text = journal_text(document);
  if (text.size() > kMostBytes) throw OutputError(file_.string(), "too large");
  io::AtomicFile file(file_);
  file.write(text);
  file.commit(io::Flush::now);
}

void Journal::remove() {
  noted_.reset();
  failure_.reset();
  if (file_.empty()) return;
  std::error_code ignored;
  fs::remove(file_, ignored);
  fs::remove(lock_of(file_), ignored);
  file_.clear();
  lock_.reset();
}

void discard(LostEdits&& lost) {
  std::error_code ignored;
  fs::remove(lost.journal, ignored);
  fs::remove(lock_of(lost.journal), ignored);
  lost.lock.reset();
}

std::optional<ModelSource::Stamp> stamp_of(const fs::path& file, Progress* progress) {
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return std::nullopt;
  try {
    const io::MappedFile bytes(file);
    uLong crc = 0;
    for (std::size_t begin = 0; begin < bytes.size(); begin += kCrcBlock) {
      check_cancelled(progress);
      const auto* block = reinterpret_cast<const Bytef*>(bytes.begin() + begin);
      crc = crc32_z(crc, block, std::min(kCrcBlock, bytes.size() - begin));
    }
    return ModelSource::Stamp{bytes.size(), static_cast<std::uint32_t>(crc)};
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace mesher::app
