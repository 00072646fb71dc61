#pragma once

#include <atomic>
#include <cstdint>
#include <initializer_list>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/time_limit.h"

namespace mesher {

/// The progress of a long operation, and whether it has been canceled. The worker writes the
/// progress; another thread reads it and may cancel. Passed as a pointer; null: nobody is watching.
///
/// The fraction covers the whole operation and never decreases. An operation divides it among its
/// stages (`Stages`); code that reports does not know which part of the whole it fills.
class Progress {
 public:
  /// Is told of every change, on the thread that makes it; several threads may tell it at once.
  class Observer {
   public:
    virtual ~Observer() = default;
    virtual void on_fraction(float fraction) = 0;  ///< in no particular order
    virtual void on_stage(std::string_view stage) = 0;
  };

  Progress() = default;
  /// `observer` must outlive this; null: nobody is told.
  explicit Progress(Observer* observer) : observer_(observer) {}

  /// Returns the finished fraction of the operation, 0 to 1.
  float fraction() const { return fraction_.load(std::memory_order_relaxed); }
  /// Returns what is being done, as text for the user ("reading"). Empty: nothing has begun.
  std::string stage() const;
  /// Sets that text. The fraction does not change.
  void name_stage(std::string_view stage);

  /// Sets the finished fraction of the current stage, 0 to 1. A smaller one than before changes
  /// nothing. Several threads may call it at once. Cost: a load, and a compare-and-swap if the
  /// fraction grows; call it once per some thousand elements.
  void set(float fraction);

  /// Cancels the operation. Returns false, and changes nothing, once it is sealed.
  bool cancel();
  /// Returns whether it was canceled, also by a TimeLimit.
  bool is_cancelled() const {
    const State state = state_.load(std::memory_order_relaxed);
    return state == State::cancelled || (state == State::running && TimeLimit::is_over());
  }
  /// The worker calls it before its result becomes visible to others, such as a file that gets its
  /// name. From then on the operation cannot be canceled, so that a canceled one leaves no trace.
  /// Throws Cancelled.
  void seal();

 private:
  friend class Stages;
  friend class OpenStages;

  /// A part of the whole operation.
  struct Part {
    double begin = 0.0;
    double end = 1.0;
  };

  Observer* observer_ = nullptr;
  std::atomic<float> fraction_{0.0F};
  enum class State : std::uint8_t { running, cancelled, sealed };
  std::atomic<State> state_{State::running};
  /// What `set` fills. Changes only while no other thread reports.
  Part part_;
  mutable std::mutex mutex_;
  std::string stage_;
};

/// Divides the current stage of a Progress, or the whole operation, into stages in proportion to
/// their times. Each function divides only what its caller gave it, so stages nest:
///
///     Stages stages(progress, {7.0, 3.0});
///     stages.next("reading");
///     Soup soup = read(file, progress);  // fills 0 % to 70 %
///     stages.next("building the mesh");
///     build(soup, progress);             // fills 70 % to 100 %
///
/// The destructor finishes the stages, except while an exception passes through. One thread creates
/// and advances the stages; inside a stage, any number of threads may report.
class Stages {
 public:
  /// `weights`: the expected time of each stage, in any unit. Null progress: does nothing.
  Stages(Progress* progress, std::span<const double> weights);
  Stages(Progress* progress, std::initializer_list<double> weights)
      : Stages(progress, std::span<const double>(weights.begin(), weights.size())) {}
  ~Stages();
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  /// Finishes the current stage and starts the next one. An empty name keeps the text of the
  /// enclosing stage. Throws Cancelled. Pre: there are no more calls than weights.
  void next(std::string_view name = {});

 private:
  Progress* progress_;
  Progress::Part whole_;
  std::vector<double> ends_;  ///< of each stage, as part of the whole operation
  std::size_t started_ = 0;
  int exceptions_;
};

/// Stages whose number is not known beforehand: each gets the same share of what the ones before it
/// left of the current stage, so the fraction never reaches the end early. Otherwise as Stages.
class OpenStages {
 public:
  /// `share`: of the remaining part that the next stage fills, above 0 and below 1: the larger, the
  /// likelier it is the last. Null progress: does nothing.
  explicit OpenStages(Progress* progress, double share = 0.5);
  ~OpenStages();
  OpenStages(const OpenStages&) = delete;
  OpenStages& operator=(const OpenStages&) = delete;

  /// Finishes the current stage and starts the next one. Throws Cancelled.
  void next();

 private:
  Progress* progress_;
  double share_;
  Progress::Part whole_;
  double end_ = 0.0;  ///< of the current stage
  int exceptions_;
};

/// Sets the finished fraction of the current stage, or throws Cancelled if `progress` was canceled.
/// If it is null, throws Cancelled after the end of a TimeLimit. Call it between units of work, not
/// in inner loops.
void report(Progress* progress, float fraction);

/// Throws Cancelled if `progress` was canceled; if it is null, after the end of a TimeLimit.
void check_cancelled(const Progress* progress);

/// Progress::seal. If it is null, throws Cancelled after the end of a TimeLimit.
void seal(Progress* progress);

/// Names what begins, or throws Cancelled if `progress` was canceled; if it is null, after the end
/// of a TimeLimit.
void begin_stage(Progress* progress, std::string_view stage);

}  // namespace mesher
