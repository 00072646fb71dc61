#include "app/document/json.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace mesher::app {
namespace {

TEST(Json, ModelHasCountsAndEveryKindOfRepair) {
  Model model;
  Soup soup = test::cube();
  soup.corners.insert(soup.corners.end(), {1U, 1U, 2U});
  BuildResult built = build_mesh(std::move(soup));
  model.mesh = std::move(built.mesh);
  model.report = built.report;
  model.name = "cube";
  const Json json = to_json(model, statistics(model.mesh), "folder/cube.obj");
  EXPECT_EQ(json["file"], "folder/cube.obj");
  EXPECT_EQ(json["statistics"]["euler_characteristic"], 2);
  EXPECT_EQ(json["statistics"]["closed"], true);
  EXPECT_EQ(json["statistics"]["box"]["max"], Json::array({0.5, 0.5, 0.5}));
  EXPECT_EQ(json["repairs"].size(), kRepairs.size());
  EXPECT_EQ(json["repairs"]["degenerate_faces_dropped"], 1);
  EXPECT_EQ(json["repairs"]["duplicate_faces_dropped"], 0);
}

TEST(Json, EmptyModelHasNoBox) {
  EXPECT_TRUE(to_json(Statistics{})["box"].is_null());
}

TEST(Json, SessionContainsItsState) {
  Session session;
  session.view.settings.shading = render::Shading::gouraud;
  session.view.settings.background = render::Background::dark;
  const Json json = to_json(session);
  EXPECT_EQ(json["shading"], "gouraud");
  EXPECT_EQ(json["background"], "dark");
  EXPECT_EQ(json["camera"]["orthographic"], false);
}

}  // namespace
}  // namespace mesher::app
