#include "app/state_log.h"

#include "app/json.h"
#include "engine/core/error.h"

namespace mesher::app {

StateLog::StateLog(const std::filesystem::path& file) {
  if (file.empty()) return;
  out_.open(file);
  if (!out_) throw OutputError(file.string(), "cannot be written");
}

void StateLog::note(const Session& session) {
  if (!out_.is_open()) return;
  std::string line = to_json(session).dump();
  if (line == last_) return;
  out_ << line << std::endl;  // at once: somebody may be waiting for it
  last_ = std::move(line);
}

}  // namespace mesher::app
