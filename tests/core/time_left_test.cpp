#include "engine/core/time_left.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace mesher {
namespace {

/// Updates ten times per second up to `end_s`. Returns the texts, without repetitions.
std::vector<std::string> texts_of(TimeLeft& left, double end_s,
                                  const std::function<double(double)>& fraction,
                                  double begin_s = 0.1) {
  std::vector<std::string> texts;
  for (double t = begin_s; t <= end_s + 1e-9; t += 0.1) {
    left.update(t, fraction(t));
    if (texts.empty() || texts.back() != left.text()) texts.push_back(left.text());
  }
  return texts;
}

/// How often the shown time grows.
int count_rises(TimeLeft& left, double end_s, const std::function<double(double)>& fraction) {
  int rises = 0;
  double before = 0.0;
  for (double t = 0.1; t <= end_s; t += 0.1) {
    left.update(t, fraction(t));
    if (before > 0.0 && left.seconds() > before) ++rises;
    before = left.seconds();
  }
  return rises;
}

TEST(TimeLeft, RoundsLikeAPerson) {
  const std::vector<std::pair<double, std::string>> expected{
      {0.01, "about 1 s left"},      {1.4, "about 1 s left"},       {3.2, "about 3 s left"},
      {9.4, "about 9 s left"},       {9.6, "about 10 s left"},      {17.0, "about 15 s left"},
      {27.0, "about 25 s left"},     {28.0, "about 30 s left"},     {42.0, "about 40 s left"},
      {54.0, "about 50 s left"},     {56.0, "about 1 min left"},    {80.0, "about 1 min left"},
      {170.0, "about 3 min left"},   {560.0, "about 9 min left"},   {580.0, "about 10 min left"},
      {1300.0, "about 20 min left"}, {3400.0, "about 55 min left"}, {3500.0, "about 1 h left"},
      {5300.0, "about 1.5 h left"},  {7300.0, "about 2 h left"}};
  for (const auto& [seconds, text] : expected)
    EXPECT_EQ(time_left_text(spoken_seconds(seconds)), text) << seconds;
}

TEST(TimeLeft, RoundedTimeIsNearAndNeverFallsAsTimeGrows) {
  double before = 0.0;
  for (double seconds = 1.0; seconds < 20'000.0; seconds *= 1.003) {
    const double spoken = spoken_seconds(seconds);
    EXPECT_GE(spoken, before) << seconds;
    EXPECT_NEAR(spoken / seconds, 1.0, 0.5) << seconds;
    before = spoken;
  }
}

TEST(TimeLeft, IsUnknownTooEarly) {
  TimeLeft left;
  left.update(1.9, 0.5);
  EXPECT_EQ(left.text(), "") << "two seconds are not over";
  left.update(2.1, 0.5);
  EXPECT_EQ(left.text(), "about 2 s left");
  TimeLeft slow;
  slow.update(30.0, 0.029);
  EXPECT_EQ(slow.text(), "") << "not three percent";
  slow.update(31.0, 0.03);
  EXPECT_NE(slow.text(), "");
}

TEST(TimeLeft, IsUnknownBeforeAnythingHappened) {
  TimeLeft left;
  EXPECT_EQ(left.text(), "");
  EXPECT_EQ(left.seconds(), 0.0);
}

TEST(TimeLeft, IsUnknownWhenFinished) {
  TimeLeft left;
  left.update(3.0, 0.9);
  EXPECT_NE(left.text(), "");
  left.update(3.5, 1.0);
  EXPECT_EQ(left.text(), "");
}

TEST(TimeLeft, IsUnknownWhileStalled) {
  TimeLeft left;
  EXPECT_EQ(texts_of(left, 10.0, [](double t) { return 0.01 * t; }).back(), "about 2 min left");
  left.update(14.9, 0.0999);
  EXPECT_NE(left.text(), "") << "a short pause is no stall";
  left.update(15.2, 0.0999);
  EXPECT_EQ(left.text(), "");
  left.update(16.0, 0.11);
  EXPECT_NE(left.text(), "") << "it moves again";
}

TEST(TimeLeft, CountsDownEvenly) {
  TimeLeft left;
  const std::vector<std::string> texts = texts_of(left, 20.0, [](double t) { return t / 20.0; });
  EXPECT_EQ(texts,
            (std::vector<std::string>{"", "about 20 s left", "about 15 s left", "about 10 s left",
                                      "about 9 s left", "about 8 s left", "about 7 s left",
                                      "about 6 s left", "about 5 s left", "about 4 s left",
                                      "about 3 s left", "about 2 s left", "about 1 s left", ""}));
}

TEST(TimeLeft, DoesNotJumpWhenTheSpeedVaries) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    double done = 0.0;
    TimeLeft left;
    const int rises = count_rises(left, 60.0, [&](double) {
      // The speed changes from update to update by a factor of up to 20.
      done += (0.1 + 1.9 * static_cast<double>(random()) / 4294967296.0) * 0.1 / 65.0;
      return std::min(done, 0.999);
    });
    EXPECT_EQ(rises, 0) << seed;
  }
}

TEST(TimeLeft, FollowsAStageThatIsSlowerThanExpected) {
  TimeLeft left;
  // Half of the work takes 5 s, the other half 45 s.
  const auto fraction = [](double t) { return t < 5.0 ? 0.1 * t : 0.5 + (t - 5.0) / 90.0; };
  texts_of(left, 5.0, fraction);
  EXPECT_LE(left.seconds(), 6.0);
  texts_of(left, 25.0, fraction, 5.1);
  EXPECT_GE(left.seconds(), 15.0) << "25 s are left";
  texts_of(left, 40.0, fraction, 25.1);
  EXPECT_NEAR(left.seconds(), 10.0, 3.0);
}

TEST(TimeLeft, ChangesAtMostOncePerSecond) {
  TimeLeft left;
  double changed_at = -10.0;
  std::string before;
  for (double t = 2.0; t < 30.0; t += 0.02) {
    left.update(t, 0.1 + 0.8 * t / 30.0 + 0.01 * std::sin(40.0 * t));
    if (left.text() == before) continue;
    EXPECT_TRUE(before.empty() || t - changed_at > 0.99) << t;
    before = left.text();
    changed_at = t;
  }
}

TEST(TimeLeft, EarlierTimeBeginsAnotherJob) {
  TimeLeft left;
  left.update(60.0, 0.5);
  EXPECT_EQ(left.text(), "about 1 min left");
  left.update(1.0, 0.5);
  EXPECT_EQ(left.text(), "");
  left.update(3.0, 0.75);
  EXPECT_EQ(left.text(), "about 1 s left") << "nothing is left of the job before";
}

TEST(ProgressText, HasStagePercentageAndTime) {
  TimeLeft left;
  EXPECT_EQ(progress_text("reading", 0.429, left), "reading 42 %");
  left.update(4.0, 0.5714);
  EXPECT_EQ(progress_text("reading", 0.5714, left), "reading 57 %, about 3 s left");
  EXPECT_EQ(progress_text("reading", 0.9999, TimeLeft()), "reading 99 %") << "not yet 100 %";
}

}  // namespace
}  // namespace mesher
