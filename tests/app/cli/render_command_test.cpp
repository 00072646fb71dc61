// Tests pictures of models at less than full detail.
#include "app/cli/render_command.h"

#include <cmath>

#include "engine/io/png.h"
#include "tests/app/program_test.h"

namespace mesher::test {
namespace {

using app::detail_moment;
using app::DetailMoment;

TEST(DetailMoment, RunsFromBaseToFullDetail) {
  const DetailMoment base = detail_moment(0.0, 80, 1600);
  EXPECT_EQ(base.level, 0U);
  EXPECT_EQ(base.time, 0.0);
  EXPECT_EQ(base.window, 10.0);
  double grown = 0.0;
  for (double lod = 0.01; lod < 1.0; lod += 0.01) {
    const DetailMoment moment = detail_moment(lod, 80, 1600);
    double now = 0.0;
    for (std::uint32_t i = 0; i < moment.level; ++i)
      now += double(growth(moment.growth, i));
    EXPECT_GT(now, grown);
    EXPECT_NEAR(now, lod * 1600, 130);  // half the largest number of splits that grow at a time
    grown = now;
  }
  const DetailMoment full = detail_moment(1.0, 80, 1600);
  EXPECT_EQ(full.level, 1600U);
  EXPECT_EQ(full.growth, GeomorphTime::done());
}

TEST(DetailMoment, MeshWithoutSplitsHasOneLevel) {
  for (const double lod : {0.0, 0.5, 1.0}) {
    EXPECT_EQ(detail_moment(lod, 80, 0).level, 0U);
    EXPECT_GT(detail_moment(lod, 80, 0).window, 0.0);
  }
}

class RenderCommand : public ProgramTest {
 protected:
  Image picture(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"-o", "r.png", "--size", "160", "--validation"});
    const Finished run = mesher(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return io::read_png(folder_ / "r.png");
  }
};

/// Mean absolute difference of the channels, 0 to 255.
double difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.rgba.size(), b.rgba.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    sum += std::abs(int(a.rgba[i]) - int(b.rgba[i]));
  return sum / double(a.rgba.size());
}

TEST_F(RenderCommand, FullDetailEqualsModel) {
  const Image full = picture({"bunny"});
  EXPECT_LT(difference(picture({"bunny", "--lod", "1"}), full), 0.05);
  EXPECT_GT(difference(picture({"bunny", "--lod", "0"}), full), 0.5);
  EXPECT_LT(
      difference(picture({"bunny", "--lod", "1", "--gouraud"}), picture({"bunny", "--gouraud"})),
      0.5);
}

TEST_F(RenderCommand, PictureChangesContinuouslyWithLod) {
  const Image at = picture({"bunny", "--lod", "0.2"});
  const Image near = picture({"bunny", "--lod", "0.2003"});  // half a split further
  const Image far = picture({"bunny", "--lod", "0.6"});
  EXPECT_LT(difference(at, near), 0.2 * difference(at, far));
}

TEST_F(RenderCommand, ProgressiveFileGivesSamePicture) {
  ASSERT_EQ(mesher({"progressive", "bunny", "-o", "b.pm"}).exit_code, 0);
  EXPECT_TRUE(picture({"b.pm", "--lod", "0.37"}).rgba == picture({"bunny", "--lod", "0.37"}).rgba);
  EXPECT_EQ(
      mesher_json({"render", "b.pm", "-o", "r.png", "--size", "20", "--faces", "1001"})["faces"],
      1000);
}

TEST_F(RenderCommand, JsonReportsDetailMoment) {
  const auto json = mesher_json({"render", "bunny", "-o", "r.png", "--size", "20", "--lod", "0.5"});
  const DetailMoment moment = detail_moment(0.5, 102, 1737);
  EXPECT_EQ(json["detail"]["lod"], 0.5);
  EXPECT_EQ(json["detail"]["splits"], 1737);
  EXPECT_EQ(json["detail"]["level"], moment.level);
  EXPECT_EQ(json["detail"]["time"], moment.time);
  EXPECT_EQ(json["detail"]["window"], moment.window);
  EXPECT_EQ(json["faces"], 200 + 2 * moment.level);
  EXPECT_FALSE(json.contains("pm"));
}

TEST_F(RenderCommand, SmallModelsHaveLevels) {
  EXPECT_LT(difference(picture({"cube", "--lod", "1"}), picture({"cube"})), 0.05);
  EXPECT_GT(difference(picture({"cube", "--lod", "0"}), picture({"cube"})), 1.0);
}

TEST_F(RenderCommand, InvalidDetailIsRejected) {
  for (const char* lod : {"-0.1", "1.1", "nan", "inf", "", "x", "0.5x"})
    EXPECT_EQ(mesher({"render", "cube", "-o", "x.png", "--lod", lod}).exit_code, 1) << lod;
  EXPECT_EQ(mesher({"render", "cube", "-o", "x.png", "--lod", "1", "--faces", "6"}).exit_code, 1);
  ASSERT_EQ(mesher({"progressive", "cube", "-o", "c.pm"}).exit_code, 0);
  EXPECT_EQ(mesher({"render", "c.pm", "-o", "x.png", "--lod", "1", "--tag-creases", "9"}).exit_code,
            1);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.png"));
}

}  // namespace
}  // namespace mesher::test
