#include "app/viewer/edit_keeper.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "app/document/tabs.h"

namespace mesher::app {

EditKeeper::Remarks EditKeeper::keep(Session& session) {
  Remarks remarks;
  const auto add = [](std::string& text, const std::string& remark) {
    if (!remark.empty()) text += (text.empty() ? "" : "\n") + remark;
  };
  journals_.try_emplace(session.document.opening, folder_);
  for (auto entry = journals_.begin(); entry != journals_.end();) {
    Document* const document = document_opened_as(session, entry->first);
    Journal& journal = entry->second;
    if (document == nullptr) {
      journal.remove();
      entry = journals_.erase(entry);
      continue;
    }
    const std::string remark = journal.note(*document);
    add(journal.is_failing() ? remarks.problem : remarks.notice, remark);
    ++entry;
  }
  return remarks;
}

bool EditKeeper::is_failing() const {
  return std::any_of(journals_.begin(), journals_.end(),
                     [](const auto& entry) { return entry.second.is_failing(); });
}

bool EditKeeper::has_edits() const {
  return std::any_of(journals_.begin(), journals_.end(),
                     [](const auto& entry) { return entry.second.has_edits(); });
}

void EditKeeper::forget() {
  for (auto& [opening, journal] : journals_)
    journal.remove();
}

void EditKeeper::look_for_lost_edits(void (*wake)()) {
  search_ = std::make_unique<JobOf<std::vector<LostEdits>>>(
      "Looking for lost edits",
      [folder = folder_](Progress& progress) { return lost_edits(folder, &progress); }, wake);
}

bool EditKeeper::take_lost_edits(Session& session) {
  if (!search_ || !search_->is_done()) return false;
  const std::unique_ptr<JobOf<std::vector<LostEdits>>> job = std::move(search_);
  try {
    for (LostEdits& lost : job->take())
      session.lost.push_back(std::move(lost));
  } catch (const std::exception& error) {
    session.document.error = error.what();
  }
  return true;
}

}  // namespace mesher::app
