#include "app/document/session.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "app/edit/edits.h"
#include "tests/app/edit/editing.h"
#include "tests/support/meshes.h"

namespace mesher::app {
namespace {

Model model_of(Soup soup, const std::string& name) {
  Model model;
  model.name = name;
  model.mesh = build_mesh(std::move(soup)).mesh;
  return model;
}

TEST(Session, AnotherModelReplacesEditsAndMessages) {
  Session s = session_with(test::torus(12, 10));
  press(s, "d s");
  s.document.creases.selected = {s.document.model.mesh.edge(Halfedge(0))};
  s.document.error = "an error";
  s.document.notice = "a notice";
  s.saving = {.shows_dialog = true, .waiting = "torus.obj"};
  const std::uint64_t generation = s.document.model_generation;

  show_model(s, model_of(test::cube(), "cube"), "cube.obj");
  EXPECT_EQ(s.document.file, "cube.obj");
  EXPECT_EQ(s.document.statistics.faces, 12U);
  EXPECT_EQ(s.document.edits.opened_faces, 12U);
  EXPECT_EQ(s.document.edits.history.undo_depth(), 0U);
  EXPECT_FALSE(s.document.edits.subdivision);
  EXPECT_FALSE(s.document.edits.last);
  EXPECT_TRUE(s.document.creases.selected.empty());
  EXPECT_EQ(s.document.error, "");
  EXPECT_EQ(s.document.notice, "");
  EXPECT_GT(s.document.model_generation, generation);
  EXPECT_FALSE(s.saving.shows_dialog);
  EXPECT_FALSE(s.saving.waiting);
}

TEST(Session, AnotherModelKeepsRulesAndLook) {
  Session s = session_with(test::torus(12, 10));
  s.document.simplify.rules.cost = simplify::CostPolicy::edge_length;
  s.document.subdivide.limit = !s.document.subdivide.limit;
  s.view.settings.wireframe = true;
  const subdivide::SubdivideOptions subdivide = s.document.subdivide;

  show_model(s, model_of(test::cube(), "cube"), "cube.obj");
  EXPECT_EQ(s.document.simplify.rules.cost, simplify::CostPolicy::edge_length);
  EXPECT_EQ(s.document.subdivide, subdivide);
  EXPECT_TRUE(s.view.settings.wireframe);
}

TEST(Session, AnotherModelIsFramedFromTheSameSide) {
  Session s = session_with(test::torus(12, 10));
  s.view.camera.set_angles(0.7, 0.3);
  const glm::dvec3 forward = s.view.camera.forward();
  Soup far_away = test::cube();
  for (glm::vec3& p : far_away.positions)
    p = 100.0F * p + glm::vec3(1000.0F, 0.0F, 0.0F);

  show_model(s, model_of(std::move(far_away), "far"), "far.obj");
  EXPECT_LT(glm::distance(s.view.camera.forward(), forward), 1e-12);
  for (const glm::vec3& p : s.document.model.mesh.positions()) {
    const glm::dvec2 at = s.view.camera.places(s.view.window).of(p);
    EXPECT_TRUE(at.x > 0.0 && at.y > 0.0 && at.x < s.view.window.x && at.y < s.view.window.y);
  }
}

}  // namespace
}  // namespace mesher::app
