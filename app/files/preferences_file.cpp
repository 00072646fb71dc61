#include "app/files/preferences_file.h"

#include <algorithm>
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

constexpr const char* kVersionKey = "mesher_settings";

/// The file was written by a later version of the program.
class LaterVersion : public InputError {
 public:
  using InputError::InputError;
};

Json preferences_json(const Preferences& preferences) {
  Json recent = Json::array();
  for (const fs::path& file : preferences.recent)
    recent.push_back(percent_encoded(file.string()));
  return {{kVersionKey, PreferencesFile::kVersion},
          {"recent", std::move(recent)},
          {"open_folder", percent_encoded(preferences.open_folder.string())},
          {"save_folder", percent_encoded(preferences.save_folder.string())},
          {"picture_folder", percent_encoded(preferences.picture_folder.string())},
          {"save_extension", preferences.save_extension},
          {"shows_hidden_files", preferences.shows_hidden_files}};
}

/// An empty path if there is none.
fs::path path_of(const Json& json, const char* key) {
  return percent_decoded(json.value(key, std::string()));
}

// A key that is missing was added by a later version, and keeps its default.
Preferences preferences_of(const Json& json) {
  Preferences preferences;
  for (const Json& file : json.value("recent", Json::array())) {
    if (preferences.recent.size() == Preferences::kMostRecent) break;
    preferences.recent.emplace_back(percent_decoded(file.get<std::string>()));
  }
  preferences.open_folder = path_of(json, "open_folder");
  preferences.save_folder = path_of(json, "save_folder");
  preferences.picture_folder = path_of(json, "picture_folder");
  preferences.save_extension = json.value("save_extension", std::string());
  preferences.shows_hidden_files = json.value("shows_hidden_files", false);
  return preferences;
}

}  // namespace

PreferencesFile::PreferencesFile(fs::path folder)
    : folder_(std::move(folder)), file_(folder_ / "settings.json"), can_write_(!folder_.empty()) {}

Preferences PreferencesFile::parse() {
  std::error_code ignored;
  if (folder_.empty() || !fs::exists(file_, ignored)) return {};
  if (!fs::is_regular_file(file_, ignored) || fs::file_size(file_, ignored) > kMostBytes)
    throw InputError(file_.string(), 0, "is not a file of settings");
  const io::MappedFile bytes(file_);
  const Json json = Json::parse(bytes.bytes());
  if (json.at(kVersionKey).get<int>() > kVersion)
    throw LaterVersion(file_.string(), 0, "was written by a later version of mesher");
  return preferences_of(json);
}

Preferences PreferencesFile::read() {
  try {
    known_ = parse();
  } catch (const LaterVersion& later) {
    can_write_ = false;
    remark_ = std::string(later.what()) + "; settings are not remembered";
  } catch (const std::exception&) {
    const fs::path aside = file_.string() + ".damaged";
    std::error_code failed;
    fs::rename(file_, aside, failed);
    can_write_ = !failed;
    remark_ = failed ? file_.string() + " is damaged; settings are not remembered"
                     : file_.string() + " was damaged; it is now " + aside.filename().string() +
                           ", and the settings are the defaults";
  }
  return known_;
}

void PreferencesFile::write(const Preferences& preferences) {
  if (preferences == known_) return;
  known_ = preferences;
  if (!can_write_) return;
  try {
    store(preferences);
    is_failing_ = false;
  } catch (const std::exception& error) {
    if (!std::exchange(is_failing_, true))
      remark_ = std::string(error.what()) + "; settings are not remembered";
  }
}

void PreferencesFile::store(Preferences preferences) {
  try {
    for (const fs::path& file : parse().recent) {
      if (preferences.recent.size() == Preferences::kMostRecent) break;
      if (std::ranges::count(preferences.recent, file) == 0) preferences.recent.push_back(file);
    }
  } catch (const std::exception&) {
    // The file is replaced as a whole, so that damage that came meanwhile does no harm.
  }
  make_folder(folder_);
  io::AtomicFile file(file_);
  file.write(to_text(preferences_json(preferences), 2));
  file.commit(io::Flush::now);
}

std::string PreferencesFile::take_remark() {
  return std::exchange(remark_, std::string());
}

}  // namespace mesher::app
