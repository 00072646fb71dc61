#include "app/document/progressive_view.h"

#include <gtest/gtest.h>

#include <cstring>

#include "app/document/automatic_level.h"
#include "app/document/json.h"
#include "app/document/shown.h"
#include "app/edit/edits.h"
#include "app/edit/progressive_edits.h"
#include "app/files/save.h"
#include "app/input/commands.h"
#include "tests/app/edit/editing.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"

namespace mesher::app {
namespace {

void press_and_settle(Session& session, const char* keys) {
  for (const KeyPress& key : parse_keys(keys)) {
    const auto command = command_for(key);
    ASSERT_NE(command, nullptr) << to_text(key);
    run(session, *command);
    run_waiting_edits(session.document);
    session.document.progressive.settle(shown_pixels_per_unit(session.document, session.view));
  }
}

class ProgressiveViewTest : public testing::Test {
 protected:
  ProgressiveViewTest() { show(test::torus(40, 30)); }

  void show(Soup soup) {
    Model model;
    model.name = "torus.obj";
    model.mesh = build_mesh(std::move(soup)).mesh;
    show_model(session_, std::move(model), "torus.obj");
  }
  ProgressiveView& view() { return session_.document.progressive; }
  std::uint32_t faces() { return view().mesh().mesh().face_count(); }
  void change(const auto& how) {
    ProgressiveSettings settings = view().settings();
    how(settings);
    view().change(settings);
  }

  Session session_;
};

TEST_F(ProgressiveViewTest, PEntersAtFullDetailAndRestoresModelOnLeaving) {
  const Mesh before = session_.document.model.mesh;
  press_and_settle(session_, "p");
  ASSERT_TRUE(view().is_on());
  EXPECT_TRUE(view().has_geomorph());
  EXPECT_EQ(faces(), 2400U);
  EXPECT_EQ(view().position(), 1.0);
  EXPECT_LE(view().mesh().base_face_count(), 200U);
  EXPECT_EQ(shown_mesh(session_.document).face_count(), 2400U);
  press_and_settle(session_, "home");
  EXPECT_EQ(faces(), view().mesh().base_face_count());
  EXPECT_EQ(&shown_mesh(session_.document), &view().mesh().mesh());
  press_and_settle(session_, "p");
  EXPECT_FALSE(view().is_on());
  EXPECT_EQ(&shown_mesh(session_.document), &session_.document.model.mesh);
  EXPECT_TRUE(is_same(session_.document.model.mesh, before));
  EXPECT_EQ(session_.document.edits.history.undo_depth(), 0U);
  EXPECT_EQ(shown_settings(session_.view.settings, session_.document), session_.view.settings);
}

TEST_F(ProgressiveViewTest, ProgressiveMeshIsKeptUntilModelChanges) {
  press_and_settle(session_, "p home p");
  EXPECT_TRUE(view().has_mesh());
  press_and_settle(session_, "p");
  EXPECT_EQ(faces(), view().mesh().base_face_count()) << "the level is kept";
  press_and_settle(session_, "p d");
  EXPECT_FALSE(view().has_mesh());
  press_and_settle(session_, "p");
  EXPECT_EQ(faces(), session_.document.statistics.faces);
}

TEST_F(ProgressiveViewTest, EscapeLeavesModeAndNeverQuits) {
  press_and_settle(session_, "p esc");
  EXPECT_FALSE(view().is_on());
  EXPECT_FALSE(session_.wants_quit);
  press_and_settle(session_, "esc");
  EXPECT_FALSE(session_.wants_quit);
}

TEST_F(ProgressiveViewTest, KeysReachEveryLevel) {
  press_and_settle(session_, "p shift+g home");
  EXPECT_EQ(view().mesh().level(), 0U);
  press_and_settle(session_, "] ] . [");
  EXPECT_EQ(view().mesh().level(), 2U);
  press_and_settle(session_, "[ , , ,");
  EXPECT_EQ(view().mesh().level(), 0U);
  press_and_settle(session_, "end");
  EXPECT_EQ(faces(), 2400U);
  press_and_settle(session_, "]");
  EXPECT_EQ(faces(), 2400U);
  press_and_settle(session_, "pagedown shift+[");
  EXPECT_NEAR(view().position(), 0.8, 1e-9);
  EXPECT_LT(faces(), 2400U);
  press_and_settle(session_, "pageup shift+] pageup");
  EXPECT_EQ(view().position(), 1.0);
}

TEST_F(ProgressiveViewTest, TogglingGeomorphsKeepsLevel) {
  press_and_settle(session_, "p");
  view().move_to_level(500);
  EXPECT_GE(view().mesh().level(), 500U);
  EXPECT_NE(view().growth(), GeomorphTime::done());
  press_and_settle(session_, "shift+g");
  EXPECT_EQ(view().mesh().level(), 500U);
  EXPECT_EQ(view().growth(), GeomorphTime::done());
  press_and_settle(session_, "shift+g");
  EXPECT_NEAR(view().range().grown(view().time()), 500.0, 1e-6);
  change([](ProgressiveSettings& s) { s.geomorph_range = 0.4F; });
  EXPECT_NEAR(view().range().grown(view().time()), 500.0, 1e-6);
  press_and_settle(session_, "end shift+g");
  EXPECT_TRUE(view().is_at_end());
  press_and_settle(session_, "shift+g");
  EXPECT_TRUE(view().is_at_end());
  EXPECT_EQ(view().growth(), GeomorphTime::done());
  press_and_settle(session_, "home shift+g");
  EXPECT_EQ(view().time(), 0.0);
  press_and_settle(session_, "shift+g");
  EXPECT_EQ(view().time(), 0.0);
}

TEST_F(ProgressiveViewTest, PlaysBackAndForth) {
  press_and_settle(session_, "p home");
  change([](ProgressiveSettings& s) { s.seconds = 2.0F; });
  EXPECT_FALSE(view().advance(0.5, 100.0)) << "nothing moves yet";
  press_and_settle(session_, "space");
  EXPECT_TRUE(view().is_playing());
  EXPECT_TRUE(view().advance(0.5, 100.0));
  EXPECT_NEAR(view().position(), 0.25, 1e-6);
  view().advance(1.0, 100.0);
  EXPECT_NEAR(view().position(), 0.75, 1e-6);
  view().advance(1.0, 100.0);  // turns at the end
  EXPECT_NEAR(view().position(), 0.75, 1e-6);
  view().advance(0.5, 100.0);
  EXPECT_NEAR(view().position(), 0.5, 1e-6);
  view().advance(1.5, 100.0);  // and at the base
  EXPECT_NEAR(view().position(), 0.25, 1e-6);
  view().advance(4.0 * 7, 100.0);
  EXPECT_NEAR(view().position(), 0.25, 1e-6) << "whole periods";
  press_and_settle(session_, "space");
  EXPECT_FALSE(view().advance(1.0, 100.0));
  press_and_settle(session_, "end space");
  view().advance(0.5, 100.0);
  EXPECT_NEAR(view().position(), 0.75, 1e-6) << "downwards from full detail";
  press_and_settle(session_, "[");
  EXPECT_FALSE(view().is_playing()) << "moving by hand ends playing";
}

TEST_F(ProgressiveViewTest, LevelErrorsDecreaseToZero) {
  press_and_settle(session_, "p");
  const progressive::LevelErrors& errors = view().levels().errors;
  const std::uint32_t splits = view().mesh().split_count();
  EXPECT_GT(errors.error(0), 0.0);
  EXPECT_EQ(errors.error(splits), 0.0);
  for (std::uint32_t i = 0; i < splits; ++i) {
    ASSERT_GE(errors.error(i), errors.error(i + 1));
    const std::uint32_t within = errors.level_within(errors.error(i));
    ASSERT_LE(within, i);
    ASSERT_EQ(errors.error(within), errors.error(i));
  }
  EXPECT_EQ(errors.level_within(1e9), 0U);
  EXPECT_EQ(errors.level_within(-1.0), splits);
}

TEST_F(ProgressiveViewTest, AutomaticLevelHasHysteresis) {
  press_and_settle(session_, "p");
  const progressive::LevelErrors& errors = view().levels().errors;
  const double unit = 0.5 / errors.error(300);  // screen-space error of level 300: half a pixel
  const std::uint32_t level = automatic_level(errors, 0, 0.5, unit);
  EXPECT_LE(level, 300U);
  EXPECT_LE(errors.error(level) * unit, 0.5 * (1.0 + 1e-6));
  EXPECT_EQ(automatic_level(errors, level, 0.5, unit), level);
  EXPECT_EQ(automatic_level(errors, level, 0.5, 0.9 * unit), level) << "a slightly larger distance";
  EXPECT_LT(automatic_level(errors, level, 0.5, 0.3 * unit), level);
  EXPECT_GT(automatic_level(errors, level, 0.5, 3.0 * unit), level);
  EXPECT_EQ(automatic_level(errors, 7, 0.5, 1e12), view().mesh().split_count());
}

TEST_F(ProgressiveViewTest, AutomaticLevelIsReachedSmoothlyAndStops) {
  press_and_settle(session_, "p");
  press_and_settle(session_, "home");
  change([](ProgressiveSettings& s) {
    s.is_automatic = true;
    s.tolerance_px = 1.0F;
  });
  const double unit = 1.0 / view().levels().errors.error(400);
  const std::uint32_t goal = automatic_level(view().levels().errors, 0, 1.0, unit);
  double last = view().position();
  int frames = 0;
  while (view().advance(1.0 / 60, unit) && ++frames < 1000) {
    EXPECT_GE(view().position(), last);
    last = view().position();
  }
  EXPECT_GT(frames, 10) << "not in one jump";
  EXPECT_LT(frames, 120);
  EXPECT_NEAR(view().range().grown(view().time()), goal, 1e-6);
  EXPECT_FALSE(view().advance(1.0 / 60, 0.9 * unit));
  EXPECT_TRUE(view().advance(1.0 / 60, 0.1 * unit));
  view().settle(0.1 * unit);
  EXPECT_LT(view().range().grown(view().time()), goal);
  view().move_by(1);
  EXPECT_FALSE(view().settings().is_automatic) << "moving by hand ends the automatic level";
}

TEST_F(ProgressiveViewTest, CloserCameraGivesFinerLevel) {
  press_and_settle(session_, "p a");
  session_.view.camera.zoom(0.02);
  view().settle(shown_pixels_per_unit(session_.document, session_.view));
  const std::uint32_t far = faces();
  session_.view.camera.zoom(50.0);
  view().settle(shown_pixels_per_unit(session_.document, session_.view));
  const std::uint32_t near = faces();
  EXPECT_LT(far, near);
  session_.view.camera.zoom(1000.0);
  EXPECT_LT(shown_pixels_per_unit(session_.document, session_.view), 1e9) << "inside the model";
}

TEST_F(ProgressiveViewTest, EditsAreRefusedWithNotice) {
  press_and_settle(session_, "d d ctrl+z p");
  const std::uint32_t faces_before = session_.document.statistics.faces;
  for (const char* key :
       {"d", "shift+d", "s", "shift+s", "ctrl+z", "ctrl+y", "c", "shift+c", "+", "ctrl+a", "m"}) {
    press_and_settle(session_, key);
    EXPECT_NE(session_.document.notice.find("or K to use this level as the model"),
              std::string::npos)
        << key;
    EXPECT_TRUE(view().is_on());
    EXPECT_FALSE(session_.document.creases.is_on);
    EXPECT_EQ(session_.document.edits.history.undo_depth(), 1U);
    EXPECT_EQ(session_.document.statistics.faces, faces_before);
  }
}

TEST_F(ProgressiveViewTest, KeysOutsideModeGiveNotice) {
  for (const char* key :
       {"space", "[", "]", "home", "end", "pageup", "shift+g", "a", "shift+b", "k"}) {
    press_and_settle(session_, key);
    EXPECT_EQ(session_.document.notice.find("press P first"), 0U)
        << key << session_.document.notice;
  }
  EXPECT_EQ(view().settings(), ProgressiveSettings());
}

TEST_F(ProgressiveViewTest, EnteringModeEndsCreaseMode) {
  press_and_settle(session_, "c ctrl+a p");
  EXPECT_TRUE(view().is_on());
  EXPECT_FALSE(session_.document.creases.is_on);
  EXPECT_TRUE(marked_edges(session_.document.creases).selected.empty());
}

TEST_F(ProgressiveViewTest, UsedLevelCanBeEditedAndUndone) {
  const Mesh before = session_.document.model.mesh;
  press_and_settle(session_, "p");
  view().move_to_level(view().mesh().split_count() / 2);
  const Mesh level = view().mesh().mesh();
  press_and_settle(session_, "k");
  EXPECT_FALSE(view().is_on());
  EXPECT_TRUE(is_same(session_.document.model.mesh, level));
  EXPECT_EQ(session_.document.statistics.faces, level.face_count());
  EXPECT_TRUE(validate(session_.document.model.mesh).empty());
  EXPECT_EQ(session_.document.edits.history.undo_name(),
            "use the level of " + std::to_string(level.face_count() / 1000) + "," +
                std::to_string(level.face_count() % 1000 + 1000).substr(1) + " faces as the model");
  press_and_settle(session_, "d");  // it can be edited
  EXPECT_LT(session_.document.statistics.faces, level.face_count());
  press_and_settle(session_, "ctrl+z ctrl+z");
  EXPECT_TRUE(is_same(session_.document.model.mesh, before));
  press_and_settle(session_, "ctrl+y");
  EXPECT_TRUE(is_same(session_.document.model.mesh, level));
}

TEST_F(ProgressiveViewTest, UsedLevelCarriesAttributesOver) {
  const Mesh& mesh = session_.document.model.mesh;
  CornerAttributes attributes;
  attributes.color.resize(mesh.halfedge_count());
  attributes.group.resize(mesh.face_count());
  attributes.groups = test::named_groups({"low", "high"});
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); ++h) {
    const std::uint32_t v = mesh.origin(Halfedge(h)).index();
    attributes.color[h] = {v % 256, v / 256, 7, 255};
  }
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
    attributes.group[f] = f < 1200 ? 0 : 1;
  session_.document.model.attributes = to_wedges(mesh, std::move(attributes));
  press_and_settle(session_, "p end");
  const auto& source = view().levels().vertex_source;
  const Shape shape = shown_shape(session_.document);
  test::expect_valid_attributes(shape);
  const Array<glm::u8vec4> color = test::corners_of(shape).color;
  ASSERT_EQ(color.size(), shape.mesh.halfedge_count());
  for (std::uint32_t h = 0; h < shape.mesh.halfedge_count(); ++h) {
    const std::uint32_t v = source[shape.mesh.origin(Halfedge(h)).index()].index();
    EXPECT_EQ(color[h], glm::u8vec4(v % 256, v / 256, 7, 255));
  }
  press_and_settle(session_, "pagedown pagedown k");
  test::expect_valid_attributes(session_.document.model);
  EXPECT_EQ(test::corners_of(session_.document.model).color.size(),
            session_.document.model.mesh.halfedge_count());
  EXPECT_EQ(session_.document.model.attributes.group.size(),
            session_.document.model.mesh.face_count());
}

TEST_F(ProgressiveViewTest, SavingWritesShownLevel) {
  press_and_settle(session_, "p pagedown pagedown");
  session_.saving.waiting = "somewhere.obj";
  const auto task = begin_save(session_.saving, session_.document);
  ASSERT_TRUE(task);
  EXPECT_EQ(task->shape->mesh.face_count(), faces());
}

TEST_F(ProgressiveViewTest, RebuildUsesRequestedBase) {
  press_and_settle(session_, "p home");
  const std::uint32_t coarse = view().mesh().base_face_count();
  change([](ProgressiveSettings& s) { s.base_faces = 1000; });
  request_rebuilt_progressive(session_.document);
  run_waiting_edits(session_.document);
  EXPECT_TRUE(view().is_on());
  EXPECT_GT(view().mesh().base_face_count(), coarse);
  EXPECT_LE(view().mesh().base_face_count(), 1000U);
  EXPECT_EQ(to_json(session_)["progressive"]["base_faces"], 1000);
  change([](ProgressiveSettings& s) { s.base_faces = 0; });
  request_rebuilt_progressive(session_.document);
  run_waiting_edits(session_.document);
  EXPECT_EQ(view().mesh().base_face_count(), coarse);
  EXPECT_TRUE(to_json(session_)["progressive"]["base_faces"].is_null());
}

TEST_F(ProgressiveViewTest, NoticeDescribesBase) {
  press_and_settle(session_, "p");
  EXPECT_EQ(session_.document.notice,
            "200 to 2,400 faces: Space plays, PageUp and PageDown change the level");
  ASSERT_TRUE(view().levels().report.has_value());
  EXPECT_EQ(view().levels().report->faces_reached, 200U);
  show(test::cube());
  press_and_settle(session_, "p");
  EXPECT_LT(view().mesh().base_face_count(), 12U) << "there is something to refine";
  EXPECT_TRUE(session_.document.notice.starts_with("4 to 12 faces: ") &&
              session_.document.notice.find("; the base is far from the model: ") !=
                  std::string::npos)
      << session_.document.notice;
  // A requested base is built at any error.
  show(test::cube());
  change([](ProgressiveSettings& s) { s.base_faces = 4; });
  press_and_settle(session_, "p");
  EXPECT_EQ(view().mesh().base_face_count(), 4U);
  EXPECT_NE(session_.document.notice.find("far from the model"), std::string::npos)
      << session_.document.notice;
}

TEST_F(ProgressiveViewTest, UsingLevelFarFromModelGivesNotice) {
  show(test::cube());
  press_and_settle(session_, "p home k");
  EXPECT_EQ(session_.document.model.mesh.face_count(), 4U);
  EXPECT_TRUE(session_.document.notice.starts_with("far from the model: "))
      << session_.document.notice;
  show(test::torus(40, 30));
  press_and_settle(session_, "p home k");
  EXPECT_EQ(session_.document.model.mesh.face_count(), 200U);
  EXPECT_EQ(session_.document.notice.find("far from"), std::string::npos)
      << session_.document.notice;
}

TEST_F(ProgressiveViewTest, OpeningModelEndsMode) {
  press_and_settle(session_, "p shift+b");
  show(test::cube());
  EXPECT_FALSE(view().is_on());
  EXPECT_FALSE(view().has_mesh());
  EXPECT_TRUE(view().settings().colors_by_split_order) << "settings stay";
  press_and_settle(session_, "p");
  EXPECT_TRUE(view().is_on()) << "even if the mesh has only a base";
  press_and_settle(session_, "home ] [ end pageup a space");
  view().advance(1.0, 100.0);
  EXPECT_LE(faces(), 12U);
}

TEST_F(ProgressiveViewTest, ShownSettingsDescribeGeomorph) {
  press_and_settle(session_, "p");
  view().move_to(0.5);
  press_and_settle(session_, "shift+b");
  const render::Settings settings = shown_settings(session_.view.settings, session_.document);
  EXPECT_TRUE(settings.colors_by_split_order);
  EXPECT_EQ(settings.first_split_vertex, view().mesh().base_vertex_count());
  EXPECT_EQ(settings.geomorph, view().growth());
  const render::Sources sources = shown_sources(session_.document);
  EXPECT_EQ(sources.morph.heads.size(), shown_mesh(session_.document).vertex_count());
  EXPECT_EQ(sources.vertex_normals.size(), shown_mesh(session_.document).vertex_count());
  EXPECT_EQ(sources.morph.splits.size(), view().mesh().split_count());
}

std::vector<std::string> keys_of(const Json& json) {
  std::vector<std::string> keys;
  for (const auto& item : json.items())
    keys.push_back(item.key());
  return keys;
}

TEST_F(ProgressiveViewTest, JsonContainsLevel) {
  const Json off = to_json(session_)["progressive"];
  EXPECT_EQ(off["on"], false);
  EXPECT_EQ(off["ready"], false);
  EXPECT_TRUE(off["level"].is_null());
  press_and_settle(session_, "p home ]");
  const Json json = to_json(session_)["progressive"];
  EXPECT_EQ(json["on"], true);
  EXPECT_EQ(json["level"], 1U);
  EXPECT_EQ(json["faces"], view().mesh().face_count(1));
  EXPECT_EQ(json["time"], 1.0);
  EXPECT_EQ(keys_of(json), keys_of(off)) << "the keys are always present";
  EXPECT_EQ(to_json(session_)["faces"], 2400U) << "the model's";
}

}  // namespace
}  // namespace mesher::app
