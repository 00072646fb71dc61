#pragma once

#include <string>

namespace mesher {

/// Rounds a time as a person would say it: to a second below 10 s, to 5 s below 30 s, to 10 s below
/// a minute, to a minute below 10 min, to 5 min below an hour, else to half an hour. At least 1 s.
double spoken_seconds(double seconds);

/// Returns "about 40 s left", "about 3 min left" or "about 1.5 h left" for a time that
/// `spoken_seconds` returned.
std::string time_left_text(double spoken_seconds);

/// The time that a job still takes, estimated from how its fraction grows. A pure function of the
/// updates: it reads no clock.
///
/// Unknown while an estimate means little: in the first kLeastSeconds, below kLeastFraction, after
/// the fraction has not grown for kStallSeconds, and when the job is finished. The speed is
/// averaged over about half of the elapsed time, so it follows a stage whose weight was wrong
/// without following every pause. What is shown changes at most once per second, and grows only
/// once the estimate has been clearly larger for kPatienceSeconds, so that it does not jump about.
class TimeLeft {
 public:
  static constexpr double kLeastSeconds = 2.0;
  static constexpr double kLeastFraction = 0.03;
  static constexpr double kStallSeconds = 5.0;
  static constexpr double kPatienceSeconds = 2.0;

  /// `elapsed_s`: since the job began. `fraction`: of the whole job, 0 to 1. A smaller time than
  /// before means another job: the estimate begins again.
  void update(double elapsed_s, double fraction);

  /// Returns the time as last shown, rounded as a person would say it; 0 if unknown.
  double seconds() const { return is_known_ ? shown_ : 0.0; }
  /// Returns "about 40 s left", or "" if unknown.
  std::string text() const;

 private:
  void follow(double elapsed_s, double fraction);
  void show(double elapsed_s, double left);

  double elapsed_ = 0.0;          ///< at the last update
  double fraction_ = 0.0;         ///< the same
  double grown_at_ = 0.0;         ///< when the fraction last grew
  double recent_fraction_ = 0.0;  ///< growth of the fraction, with weights that fade over time
  double recent_seconds_ = 0.0;   ///< time, with the same weights
  bool is_known_ = false;
  double shown_ = 0.0;          ///< 0: nothing has been shown
  double shown_at_ = 0.0;       ///< when it last changed
  double larger_since_ = -1.0;  ///< since when the estimate is clearly larger; negative: it is not
};

/// Returns the line that shows a job: "reading 42 %, about 3 s left". The percentage is rounded
/// down, because 100 % means that the work is done.
std::string progress_text(const std::string& stage, double fraction, const TimeLeft& left);

}  // namespace mesher
