#include "app/edit/edit_text.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"
#include "tests/app/edit/editing.h"

namespace mesher::app {
namespace {

void repeat(Session& session, const std::string& text) {
  request(session.document.edits, edit_from_text(text, session.document));
  run_waiting_edits(session.document);
  test::expect_valid(session.document.model.mesh);
}

/// Expects that the texts of the history, run on the same model under other rules, give the same
/// model.
void expect_repeatable(const Session& edited, Session fresh) {
  fresh.document.simplify.rules.cost = simplify::CostPolicy::random;
  fresh.document.simplify.rules.seed = 99;
  fresh.document.subdivide.scheme = subdivide::Scheme::midpoint;
  const History& history = edited.document.edits.history;
  ASSERT_GT(history.done_steps(), 0U);
  for (std::size_t i = 0; i < history.done_steps(); ++i)
    repeat(fresh, history.steps()[i].text);
  EXPECT_TRUE(is_same(fresh.document.model.mesh, edited.document.model.mesh));
  const History& repeated = fresh.document.edits.history;
  ASSERT_EQ(repeated.done_steps(), history.done_steps());
  for (std::size_t i = 0; i < history.done_steps(); ++i) {
    EXPECT_EQ(repeated.steps()[i].text, history.steps()[i].text);
    EXPECT_EQ(repeated.steps()[i].name, history.steps()[i].name);
  }
}

TEST(EditText, EverySimplificationIsRepeatable) {
  for (std::size_t p = 0; p < simplify::kCostPolicies.size(); ++p) {
    Session s = session_with(test::torus(30, 20));
    s.document.simplify.rules.cost = static_cast<simplify::CostPolicy>(p);
    s.document.simplify.rules.placement = simplify::Placement::midpoint;
    s.document.simplify.rules.seed = 7;
    press(s, "d shift+d d");
    request_simplify_to(s.document, 500);
    s.document.simplify.max_error_percent = 0.3F;
    request_simplify_to(s.document, 4);
    run_waiting_edits(s.document);
    expect_repeatable(s, session_with(test::torus(30, 20)));
  }
}

TEST(EditText, LevelsAndRulesAreRepeatable) {
  Session s = session_with(test::grid(6));
  press(s, "s m s l r shift+s d s");
  expect_repeatable(s, session_with(test::grid(6)));
}

TEST(EditText, CreasesAreRepeatable) {
  Session s = session_with(test::cube());
  s.document.creases.tag_angle_deg = 30.0F;
  press(s, "shift+c ctrl+a - - s ctrl+a + x");
  request_crease_edit(s.document, {.kind = CreaseRequest::Kind::clear_all});
  run_waiting_edits(s.document);
  press(s, "shift+c ctrl+a i");
  expect_repeatable(s, session_with(test::cube()));
}

TEST(EditText, LevelOfAProgressiveMeshIsRepeatable) {
  Session s = session_with(test::torus(40, 30));
  s.document.simplify.rules.cost = simplify::CostPolicy::edge_length;
  press(s, "d p");
  ASSERT_TRUE(s.document.progressive.is_on());
  s.document.progressive.move_to_level(s.document.progressive.mesh().split_count() / 3);
  press(s, "k s");
  expect_repeatable(s, session_with(test::torus(40, 30)));
}

TEST(EditText, UsesTheRulesOfTheDocumentWhereItListsNone) {
  Session s = session_with(test::torus(20, 10));
  s.document.subdivide.scheme = subdivide::Scheme::midpoint;
  repeat(s, "subdivide");
  EXPECT_NE(s.document.edits.history.steps()[0].text.find("scheme=midpoint"), std::string::npos);
  repeat(s, "simplify_to faces=100 cost=length");
  EXPECT_EQ(s.document.model.mesh.face_count(), 100U);
}

TEST(EditText, RefusesBadText) {
  const Session s = session_with(test::cube());
  const std::pair<const char*, const char*> bad[] = {
      {"", "an edit is empty"},
      {"undo", "there is no edit 'undo'"},
      {"simplify_to", "simplify_to: faces is missing"},
      {"simplify_to faces=x", "simplify_to: 'x' is not a value of faces"},
      {"simplify_to faces=-1", "simplify_to: '-1' is not a value of faces"},
      {"simplify_to faces=5 faces=6", "simplify_to: faces is given twice"},
      {"simplify_to 5", "simplify_to: '5' is not of the form key=value"},
      {"simplify cost=cheap", "simplify: 'cheap' is not a value of cost"},
      {"simplify scheme=loop",
       "simplify: unknown option 'scheme'; it takes cost, placement, boundary, crease-angle, seed, "
       "weight-uv, weight-normal, weight-color, weight-joint, no-intersections, max-error, mesh"},
      {"simplify_to face=4",
       "simplify_to: unknown option 'face'; it takes cost, placement, boundary, crease-angle, "
       "seed, weight-uv, weight-normal, weight-color, weight-joint, no-intersections, max-error, "
       "mesh, faces"},
      {"clear_all_creases by=1", "clear_all_creases: unknown option 'by'; it takes none"},
      {"subdivide limit=maybe", "subdivide: 'maybe' is not a value of limit"},
      {"set_sharpness to=-1", "set_sharpness: '-1' is not a value of to"},
      {"set_sharpness to=nan", "set_sharpness: 'nan' is not a value of to"},
      {"mark_creases", "mark_creases: angle is missing"},
      {"keep_level base-faces=3", "keep_level: splits is missing"},
  };
  for (const auto& [text, reason] : bad) {
    try {
      (void)edit_from_text(text, s.document);
      ADD_FAILURE() << text;
    } catch (const UsageError& error) {
      EXPECT_STREQ(error.what(), reason) << text;
    }
  }
}

TEST(EditText, RefusesEdgesAndLevelsThatAreNotThere) {
  Session s = session_with(test::cube());
  for (const char* text :
       {"set_sharpness to=1 edges=1000", "change_sharpness by=1 edges=x", "keep_level splits=3"}) {
    request(s.document.edits, edit_from_text(text, s.document));
    EXPECT_THROW(run_waiting_edits(s.document), UsageError) << text;
  }
  EXPECT_EQ(s.document.edits.history.undo_depth(), 0U);
}

}  // namespace
}  // namespace mesher::app
