#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/crease_edits.h"
#include "app/history.h"
#include "app/progressive_edits.h"
#include "app/shape.h"
#include "app/subdivision.h"
#include "engine/mesh/model.h"
#include "engine/simplify/options.h"
#include "engine/simplify/report.h"

namespace mesher::app {

/// By which rules the next simplification goes, as the panel shows them.
struct SimplifySettings {
  CostPolicy cost = CostPolicy::quadric;
  Placement placement = Placement::optimal;
  BoundaryRule boundary = BoundaryRule::preserve;
  float crease_angle_deg = 180.0F;  ///< 180: tagged creases only
  float max_error_percent = 0.0F;   ///< of the diagonal; 0: no bound
  std::uint32_t seed = 1;           ///< of the random policy

  friend bool operator==(const SimplifySettings&, const SimplifySettings&) = default;
};

/// What a command or a panel asks to be done to the model.
struct EditRequest {
  enum class Kind : std::uint8_t {
    remove_tenth,  ///< about 10 % of the faces, at least one collapse
    remove_edge,   ///< one collapse
    simplify_to,   ///< `target_faces`, from the model as it was opened: so detail comes back, too
    undo,
    redo,
    creases,     ///< `creases`
    finer,       ///< one level of subdivision more
    coarser,     ///< one less, down to what was subdivided
    same_level,  ///< what is shown, by the rules that now hold
    /// No edit: a progressive mesh of the model, and the mode that shows it. Where there is one
    /// already, another one only where `rebuilds` is set.
    progressive,
    geomorph,    ///< no edit: what a progressive mesh from a file lacks
    keep_level,  ///< the level of the progressive mesh that is shown becomes the model
  };
  Kind kind = Kind::remove_tenth;
  std::uint32_t target_faces = 0;
  bool rebuilds = false;
  CreaseRequest creases{};
  // The rules that held when it was asked for: until it is done, those of the session may change.
  SimplifySettings simplify{};
  SubdivideSettings subdivide{};
};

/// The ledger of a simplification.
struct SimplifyOutcome {
  SimplifyReport report;
  double diagonal = 0.0;             ///< of the input's box: what percentages refer to
  std::vector<std::string> dropped;  ///< attributes that could not be carried
  /// RMS distance from the model as it was opened (distance_from_input), model units; none where
  /// that is what the simplification started from, or where so many faces are left that it is
  /// small.
  std::optional<double> error_from_opened{};
  double percent(double distance) const { return diagonal > 0.0 ? 100.0 * distance / diagonal : 0; }
  /// The larger of what this step did and of what all of them did, in percent of the diagonal.
  double error_percent() const {
    return percent(std::max(report.estimated_error, error_from_opened.value_or(0.0)));
  }
  bool is_far() const { return error_percent() > 100.0 * kFarFromInput; }
};

/// What has been done to the model that is shown, and what is to be done.
struct Edits {
  History history;
  /// As it was opened, with the creases that it got in that detail; null: as it is shown.
  std::shared_ptr<const Shape> opened;
  std::uint32_t opened_faces = 0;
  std::optional<SimplifyOutcome> last;
  std::optional<SubdivideOutcome> last_subdivision;
  /// Of what the model is a level; none: nothing is kept that is coarser.
  std::optional<SubdivisionLevel> subdivision;
  /// What a command asks of whoever runs the session: to be done in this order.
  std::deque<EditRequest> waiting;
  bool was_undone = false;  ///< what was done last is an undo
  /// Grows with every change of the model: tells whoever keeps what follows from it.
  std::uint64_t revision = 0;
};

struct Session;

/// A simplification in the background: what of, and how.
struct Simplification {
  std::shared_ptr<const Shape> start;   ///< what is shown, or what was opened
  std::shared_ptr<const Shape> opened;  ///< may be the same
  SimplifyOptions options;
};

/// Everything that work in the background needs and nothing that anybody else changes: it
/// may run on another thread.
struct EditTask {
  std::string title;  ///< "Simplifying to 4,500 faces"
  std::string name;   ///< in the history; empty: after the number of faces reached
  std::shared_ptr<const Shape> shown;
  Statistics statistics;  ///< of what is shown
  std::variant<Simplification, SubdivisionLevel, ProgressiveWork, GeomorphWork, KeptLevel> work;
};

struct EditResult {
  Edit edit;
  std::optional<SimplifyOutcome> simplified;
  std::optional<SubdivideOutcome> subdivided;
  std::optional<DetailLevels> levels;
  std::string notice;  ///< what a person should know besides
};

/// Lets a request wait for its turn, by the rules that the session has now.
void request_edit(Session& session, EditRequest request);

/// Takes the first waiting request. Undo, redo and edits of creases are done at once and give
/// nothing; so does what cannot be done, with a notice. Otherwise the task to perform. O(V + F):
/// the model is copied. Pre: something waits.
std::optional<EditTask> begin_edit(Session& session);
/// Does the work; touches no session. Throws Cancelled.
EditResult perform(const EditTask& task, Progress* progress);
/// Changes the model as the result says, in place, so that a mirror has only the difference to
/// copy; says in the notice what a person should know. The camera stays. O(differences).
void finish_edit(Session& session, EditResult&& result);

/// The model has changed. Picked edges are forgotten unless it `keeps_topology`; where it does, and
/// is shown in the detail in which it was opened, simplification starts from it as it is now (to
/// know, the arrays are compared with those that were opened, once something has been simplified).
void note_model_changed(Session& session, bool keeps_topology);

/// Does an edit to the model and keeps it in the history. An edit without `subdivision_after` ends
/// the levels of subdivision: what it makes is no level of anything. O(differences).
void record_edit(Session& session, Edit&& edit);

/// Takes back what was done last, because what it made cannot be shown: an edit for good, an undo
/// by doing its edit again. Returns false where there is none. Pre: no task runs, which would start
/// from what was made. O(differences).
bool take_back_last_edit(Session& session);

/// All that waits, one after the other, here and now.
void run_waiting_edits(Session& session);

}  // namespace mesher::app
