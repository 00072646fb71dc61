#include "app/files/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <chrono>
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
std::string problem_of(const LostEdits& lost) {
  const auto stamp = stamp_of(lost.file);
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

std::vector<LostEdits> lost_edits(const fs::path& folder) {
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
      lost.problem = problem_of(lost);
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
  if (folder_.empty() || failed_opening_ == document.opening) return "";
  // Lost edits are not repeated yet.
  if (!document.edits.waiting.empty() || document.edits.is_changing) return "";
  const History& history = document.edits.history;
  const Noted now{document.opening, history.state(), history.steps().size()};
  const bool is_saved = history.state() == document.edits.saved_state;
  if (is_saved ? !noted_ && !document.edits.restored : noted_ == now) return "";
  try {
    if (is_saved) {
      remove();
    } else if (!document.source.stamp) {
      failed_opening_ = document.opening;
      return "these edits cannot be restored after a crash, because the model cannot be read again";
    } else {
      write(document);
      noted_ = now;
    }
    std::optional<LostEdits>& restored = document.edits.restored;
    if (restored && history.steps().size() >= restored->texts.size()) {
      discard(std::move(*restored));
      restored.reset();
    }
    return "";
  } catch (const std::exception& error) {
    failed_opening_ = document.opening;
    return std::string("edits cannot be restored after a crash: ") + error.what();
  }
}

void Journal::write(const Document& document) {
  if (file_.empty()) {
    fs::create_directories(folder_);
    const auto now = std::chrono::system_clock::now().time_since_epoch().count();
    file_ = folder_ / fmt::format("{}-{}{}", ::getpid(), now, kExtension);
    lock_ = FileLock::try_lock(lock_of(file_));
    if (!lock_) throw OutputError(lock_of(file_).string(), "cannot be written");
  }
  const std::string text = journal_text(document);
  if (text.size() > kMostBytes) throw OutputError(file_.string(), "too large");
  io::AtomicFile file(file_);
  file.write(text);
  file.commit();
}

void Journal::remove() {
  noted_.reset();
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

std::optional<ModelSource::Stamp> stamp_of(const fs::path& file) {
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return std::nullopt;
  try {
    const io::MappedFile bytes(file);
    const auto crc = crc32_z(0, reinterpret_cast<const Bytef*>(bytes.begin()), bytes.size());
    return ModelSource::Stamp{bytes.size(), static_cast<std::uint32_t>(crc)};
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace mesher::app
