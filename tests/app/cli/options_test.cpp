#include "app/cli/options.h"

#include <gtest/gtest.h>

#include "app/document/session.h"
#include "engine/core/error.h"
#include "tests/support/meshes.h"

namespace mesher::app {
namespace {

TEST(Options, SizeIsOneOrTwoNumbers) {
  EXPECT_EQ(parse_size("500").width, 500U);
  EXPECT_EQ(parse_size("500").height, 500U);
  EXPECT_EQ(parse_size("640x480").height, 480U);
  for (const char* bad : {"", "0", "-5", "1.5", "x", "5x", "x5", "1x2x3", "99999", "nan", "5 5"}) {
    EXPECT_THROW((void)parse_size(bad), UsageError) << bad;
  }
}

TEST(Options, CameraIsTwoAnglesAndOptionalZoom) {
  EXPECT_NEAR(parse_camera("90,-45").yaw_rad, 1.5707963, 1e-6);
  EXPECT_NEAR(parse_camera("90,-45").pitch_rad, -0.7853982, 1e-6);
  EXPECT_EQ(parse_camera("0,0,2.5").zoom, 2.5);
  for (const char* bad :
       {"", "30", "30,", "a,b", "1,2,3,4", "1,2,0", "1,2,-1", "1,2,1e30", "inf,0"}) {
    EXPECT_THROW((void)parse_camera(bad), UsageError) << bad;
  }
}

TEST(Options, LookOptionsSetSettingsAndCamera) {
  Session session;
  Model model;
  model.mesh = build_mesh(test::cube()).mesh;
  show_model(session, std::move(model), "cube.obj");
  apply_look(session.view, session.document.statistics.box,
             {.settings = {.wireframe = true, .crease_angle_deg = 40.0F},
              .gouraud = true,
              .camera = "90,0,2",
              .orthographic = true,
              .dark = true});
  EXPECT_TRUE(session.view.settings.wireframe);
  EXPECT_EQ(session.view.settings.shading, render::Shading::gouraud);
  EXPECT_EQ(session.view.settings.background, render::Background::dark);
  EXPECT_EQ(session.view.settings.crease_angle_deg, 40.0F);
  EXPECT_TRUE(session.view.camera.is_orthographic());
  EXPECT_NEAR(session.view.camera.forward().x, -1.0, 1e-12);
  const double distance = session.view.camera.distance();
  apply_look(session.view, session.document.statistics.box,
             {.camera = "90,0", .orthographic = true});
  EXPECT_NEAR(session.view.camera.distance(), 2.0 * distance, 1e-9);
}

TEST(Options, NoShadingTurnsWireframeOn) {
  Session session;
  apply_look(session.view, session.document.statistics.box,
             {.settings = {.shading = render::Shading::none}});
  EXPECT_EQ(session.view.settings.shading, render::Shading::none);
  EXPECT_TRUE(session.view.settings.wireframe);
}

}  // namespace
}  // namespace mesher::app
