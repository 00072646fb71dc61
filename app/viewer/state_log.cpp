#include "app/viewer/state_log.h"

#include "app/document/json.h"
#include "engine/core/error.h"

namespace mesher::app {

StateLog::StateLog(const std::filesystem::path& file) : file_(file) {
  if (file.empty()) return;
  out_.open(file);
  if (!out_) throw OutputError(file.string(), "cannot be written");
}

void StateLog::note(const Session& session, const Pointer* pointer, const WidgetAreas* widgets) {
  if (!out_.is_open()) return;
  Json state = to_json(session);
  Json& its_pointer = state["pointer"];
  if (pointer != nullptr) {
    its_pointer = {{"at", {pointer->at.x, pointer->at.y}}, {"pressed", pointer->is_pressed}};
  }
  if (widgets != nullptr) {
    Json& places = state["widgets"];
    for (const auto& [name, area] : *widgets)
      places[name] = {area.x, area.y, area.z, area.w};
  }
  std::string line = to_text(state, -1);
  if (line == last_) return;
  out_ << line << std::endl;  // flushed, because a test may be waiting for the line
  if (!out_) throw OutputError(file_.string(), "cannot be written");
  last_ = std::move(line);
}

}  // namespace mesher::app
