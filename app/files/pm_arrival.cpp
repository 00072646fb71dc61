#include "app/files/pm_arrival.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>
#include <vector>

#include "app/document/session.h"
#include "app/document/tabs.h"
#include "app/edit/progressive_edits.h"
#include "app/files/journal.h"
#include "engine/core/error.h"
#include "engine/io/pm_file.h"

namespace mesher::app {
namespace {

namespace fs = std::filesystem;

// Below full detail: time between two readings, and minimum time of each.
constexpr double kSecondsBetween = 0.15;
constexpr double kBiteSeconds = 0.1;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

PmArrival::PmArrival(const fs::path& file)
    : file_(file),
      is_pipe_(io::is_pipe(file)),
      reader_(std::make_unique<progressive::PmReader>(file.string())),
      stream_(file) {
  if (is_pipe_) reader_->ignore_what_follows();
}

bool PmArrival::advance(Session& session, double seconds) {
  if (is_done_ || !has_news(session.document.progressive)) return false;
  bool is_new = feed(session, seconds);
  if (is_over(session.document.progressive)) {
    end(session);
    is_new = true;
  }
  return is_new;
}

/// Data after damage cannot be used, and a pipe may never end: damage ends the reading, and so does
/// the last split of a pipe.
bool PmArrival::is_over(ProgressiveView& progressive) const {
  if (stream_.is_at_end()) return true;
  if (!has_base_) return false;
  const progressive::PmReader& reader = *progressive.reader();
  return !reader.damage().empty() || (is_pipe_ && reader.is_complete());
}

bool PmArrival::has_news(const ProgressiveView& progressive) const {
  if (!stream_.has_news()) return false;
  const bool is_at_rest = !has_base_ || progressive.is_at_end() || stream_.is_at_end();
  return is_at_rest || now_s() - last_fed_s_ >= kSecondsBetween;
}

/// Goes to full detail, where splits are appended. Returns the minimum time to read, in seconds, so
/// that going to full detail and back does not take most of the time.
double PmArrival::climb(ProgressiveView& progressive) const {
  if (!has_base_ || progressive.is_at_end()) return 0.0;
  const double begin = now_s();
  progressive::ProgressiveMesh& mesh = progressive.mesh();
  mesh.go_to(mesh.split_count());
  return std::max(kBiteSeconds, 2.0 * (now_s() - begin));
}

bool PmArrival::feed(Session& session, double seconds) {
  const double least = climb(session.document.progressive);
  const double end = now_s() + std::max(seconds, least);
  bool is_new = false;
  do {
    const io::ByteStream::Block block = stream_.take();
    if (block.empty()) break;
    progressive::PmReader& reader = has_base_ ? *session.document.progressive.reader() : *reader_;
    reader.feed(block);
    if (!has_base_ && reader.has_base()) show_base(session);
    is_new = is_new || has_base_;
  } while (now_s() < end && !is_over(session.document.progressive));
  last_fed_s_ = now_s();
  if (is_new) session.document.progressive.reader_was_fed();
  return is_new;
}

void PmArrival::show_base(Session& session) {
  Model model;
  model.name = file_.filename().string();
  model.mesh = reader_->mesh().mesh();
  add_tab(session);
  show_model(session, std::move(model), file_);
  session.document.progressive.show(std::move(reader_));
  enter_progressive(session.document);
  has_base_ = true;
}

void PmArrival::end(Session& session) {
  is_done_ = true;
  if (!has_base_) {
    reader_->finish();  // throws, and says what is missing
    if (!reader_->has_base())
      throw InputError(file_.string(), 0, "ends before the base mesh is complete");
    show_base(session);
  } else {
    session.document.progressive.reader()->finish();
  }
  const std::string damage(session.document.progressive.reader()->damage());
  const std::string failure = stream_.failure();
  stream_.close();
  stop(session.document);
  session.document.source.stamp = stamp_of(file_);
  if (!damage.empty()) session.document.error = file_.string() + ": " + damage;
  if (!failure.empty()) session.document.error = file_.string() + ": " + failure;
}

/// Returns what the view has at full detail. The view stays at its level, even if memory runs out.
Model PmArrival::model_at_full_detail(ProgressiveView& view,
                                      std::span<const std::byte> materials) const {
  progressive::ProgressiveMesh& mesh = view.mesh();
  progressive::ProgressiveAttributes& attributes = view.attributes();
  const auto go_to = [&](std::uint32_t level) {
    mesh.go_to(level);
    if (!attributes.is_empty()) attributes.go_to(level);
  };
  const std::uint32_t level = mesh.level();
  Model model;
  try {
    go_to(mesh.split_count());
    model.mesh = mesh.mesh();
    model.materials = io::take_materials(materials, file_, attributes, model.contents);
    if (!attributes.is_empty()) model.attributes = attributes.at_level(model.mesh);
  } catch (...) {
    go_to(level);
    throw;
  }
  go_to(level);
  return model;
}

void PmArrival::stop(Document& document) {
  is_done_ = true;
  ProgressiveView& view = document.progressive;
  const std::span<const std::byte> appendix = view.reader()->appendix();
  const std::vector<std::byte> materials(appendix.begin(), appendix.end());
  view.end_reading();
  // Everything that needs memory comes first, so that a failure leaves the model unchanged.
  Model read = model_at_full_detail(view, materials);
  document.statistics = statistics(read.mesh);
  document.model.mesh = std::move(read.mesh);
  document.model.attributes = std::move(read.attributes);
  document.model.materials = std::move(read.materials);
  document.model.contents = std::move(read.contents);
  document.edits.opened_faces = document.statistics.faces;
  document.edits.opened_diagonal = document.statistics.box.diagonal();
  request_geomorph(document);
}

void PmArrival::wait_for_base(Session& session, double seconds) {
  const double end = now_s() + seconds;
  while (!has_base_ && !is_done_ && now_s() < end) {
    if (!advance(session, 0.0)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void PmArrival::finish(Session& session) {
  while (!is_done_) {
    stream_.wait();
    advance(session, 1.0);
  }
}

}  // namespace mesher::app
