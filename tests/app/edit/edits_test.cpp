#include "app/edit/edits.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "app/document/session.h"
#include "app/edit/simplify_edit.h"
#include "app/input/commands.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/read.h"
#include "engine/simplify/simplify.h"
#include "tests/app/edit/editing.h"
#include "tests/support/attributes.h"
#include "tests/support/meshes.h"
#include "tests/support/watched.h"

namespace mesher::app {
namespace {

Session session_with_cactus() {
  Session session;
  show_model(session, io::read_model(MESHER_SOURCE_DIR "/assets/cactus.obj"), "cactus.obj");
  return session;
}

void simplify_to(Session& session, std::uint32_t faces) {
  request_simplify_to(session.document, faces);
  run_waiting_edits(session.document);
}

/// Expects a valid mesh, and statistics that match it.
void expect_consistent(const Session& session) {
  test::expect_valid(session.document.model.mesh);
  const Statistics fresh = statistics(session.document.model.mesh);
  EXPECT_EQ(session.document.statistics.faces, fresh.faces);
  EXPECT_EQ(session.document.statistics.vertices, fresh.vertices);
  EXPECT_EQ(session.document.statistics.edges, fresh.edges);
  EXPECT_EQ(session.document.statistics.area, fresh.area);
}

TEST(Edits, DRemovesTenPercentAndKeepsCamera) {
  Session s = session_with(test::torus(12, 10));
  const render::Camera camera = s.view.camera;
  press(s, "d");
  EXPECT_LE(s.document.statistics.faces, 216U);
  EXPECT_GE(s.document.statistics.faces, 215U);
  expect_consistent(s);
  EXPECT_TRUE(s.view.camera == camera);
  EXPECT_EQ(s.document.model_generation, 1U);
  ASSERT_TRUE(s.document.edits.last);
  EXPECT_EQ(s.document.edits.last->report.faces_asked, 216U);
  EXPECT_EQ(s.document.edits.history.undo_name(),
            "remove 10 % of faces -> " + count_text(s.document.statistics.faces));
  EXPECT_EQ(s.document.notice, "");
}

TEST(Edits, ShiftDCollapsesOneEdge) {
  Session s = session_with(test::torus(12, 10));
  press(s, "shift+d");
  EXPECT_EQ(s.document.statistics.faces, 238U);
  EXPECT_EQ(s.document.edits.last->report.collapses, 1U);
  expect_consistent(s);
  // The change log, which the GPU's mirror reads, holds only the changed elements.
  EXPECT_FALSE(s.document.model.mesh.changes().is_whole(GpuArray::origin));
  std::uint32_t noted = 0;
  for (const ChangedRange r : s.document.model.mesh.changes().merged(GpuArray::origin))
    noted += r.end - r.begin;
  EXPECT_LT(noted, 60U);
}

TEST(Edits, DStopsAtLastLegalCollapseWithNotice) {
  Session s = session_with(test::cube());
  const auto is_at_end = [&] {
    return s.document.notice.starts_with("no legal collapse is left: ");
  };
  for (int i = 0; i < 20 && !is_at_end(); ++i)
    press(s, "d");
  const std::string notice =
      "no legal collapse is left: " + std::to_string(s.document.statistics.faces) + " faces";
  EXPECT_GE(s.document.statistics.faces, 4U);
  EXPECT_TRUE(s.document.notice.starts_with(notice)) << s.document.notice;
  const std::size_t depth = s.document.edits.history.undo_depth();
  press(s, "d");
  EXPECT_TRUE(s.document.notice.starts_with(notice)) << s.document.notice;
  EXPECT_EQ(s.document.edits.history.undo_depth(), depth) << "nothing has changed";
  press(s, "shift+d");
  EXPECT_TRUE(s.document.notice.starts_with(notice)) << s.document.notice;
  expect_consistent(s);
}

TEST(Edits, UndoAndRedoRestoreArraysExactly) {
  Session s = session_with(test::join(test::torus(12, 10), test::grid(6), {0, 0, 5}));
  std::vector<Mesh> states{s.document.model.mesh};
  for (const char* key : {"d", "shift+d", "d", "d"}) {
    press(s, key);
    states.push_back(s.document.model.mesh);
  }
  for (std::size_t i = states.size() - 1; i-- > 0;) {
    press(s, "ctrl+z");
    EXPECT_TRUE(is_same(s.document.model.mesh, states[i])) << i;
    expect_consistent(s);
  }
  press(s, "ctrl+z");
  EXPECT_EQ(s.document.notice, "nothing to undo");
  for (std::size_t i = 1; i < states.size(); ++i) {
    press(s, i % 2 == 0 ? "ctrl+y" : "ctrl+shift+z");
    EXPECT_TRUE(is_same(s.document.model.mesh, states[i])) << i;
    expect_consistent(s);
  }
  press(s, "ctrl+y");
  EXPECT_EQ(s.document.notice, "nothing to redo");
}

TEST(Edits, SliderRestoresDetail) {
  Session s = session_with(test::torus(12, 10));
  const Mesh opened = s.document.model.mesh;
  simplify_to(s, 120);
  EXPECT_LE(s.document.statistics.faces, 120U);
  const Mesh coarse = s.document.model.mesh;
  simplify_to(s, 150);
  EXPECT_LE(s.document.statistics.faces, 150U);
  EXPECT_GE(s.document.statistics.faces, 149U);
  expect_consistent(s);
  simplify_to(s, 240);
  EXPECT_TRUE(is_same(s.document.model.mesh, opened));
  EXPECT_EQ(s.document.edits.last->report.reason, simplify::StopReason::already_there);
  press(s, "ctrl+z ctrl+z");
  EXPECT_TRUE(is_same(s.document.model.mesh, coarse));
  press(s, "ctrl+z");
  EXPECT_TRUE(is_same(s.document.model.mesh, opened));
}

TEST(Edits, ResultFarFromOpenedModelGivesNotice) {
  Session s = session_with_cactus();
  simplify_to(s, 100);
  EXPECT_FALSE(s.document.edits.last->is_far());
  EXPECT_EQ(s.document.notice, "");
  simplify_to(s, 24);
  EXPECT_TRUE(s.document.edits.last->is_far());
  EXPECT_NE(s.document.notice.find("far from the opened model: "), std::string::npos)
      << s.document.notice;
}

/// No single step is far from the previous one.
TEST(Edits, DMeasuresDistanceFromOpenedModel) {
  Session s = session_with_cactus();
  press(s, "d");
  EXPECT_FALSE(s.document.edits.last->error_from_opened.has_value())
      << "it starts from the opened model";
  bool was_near = false;
  for (int i = 0; i < 60 && s.document.notice.empty(); ++i) {
    was_near = !s.document.edits.last->is_far();
    press(s, "d");
  }
  EXPECT_TRUE(was_near);
  ASSERT_TRUE(s.document.edits.last->error_from_opened.has_value());
  EXPECT_TRUE(s.document.edits.last->is_far());
  EXPECT_LT(s.document.edits.last->percent(s.document.edits.last->report.estimated_error), 5.0);
  EXPECT_TRUE(s.document.notice.starts_with("far from the opened model: ")) << s.document.notice;
}

TEST(Edits, SliderStartsFromOpenedModel) {
  Session by_detour = session_with(test::torus(12, 10));
  press(by_detour, "d d shift+d");
  simplify_to(by_detour, 100);
  Session direct = session_with(test::torus(12, 10));
  simplify_to(direct, 100);
  EXPECT_TRUE(is_same(by_detour.document.model.mesh, direct.document.model.mesh));
}

TEST(Edits, SettingsArePassedToSimplifier) {
  const SimplifySettings settings{.rules = {.cost = simplify::CostPolicy::random,
                                            .placement = simplify::Placement::midpoint,
                                            .boundary = simplify::BoundaryRule::lock,
                                            .crease_angle_deg = 40.0F,
                                            .seed = 9},
                                  .max_error_percent = 2.0F};
  const simplify::SimplifyOptions options = options_of(settings, 10.0);
  EXPECT_EQ(options.cost, simplify::CostPolicy::random);
  EXPECT_EQ(options.placement, simplify::Placement::midpoint);
  EXPECT_EQ(options.boundary, simplify::BoundaryRule::lock);
  EXPECT_EQ(options.crease_angle_deg, 40.0F);
  EXPECT_NEAR(options.max_error, 0.2, 1e-6);
  EXPECT_EQ(options.seed, 9U);
  EXPECT_EQ(options.order, simplify::ResultOrder::fill_holes);

  Session s = session_with(test::grid(6));
  s.document.simplify = settings;
  request_remove_tenth(s.document);
  const auto task = start_next_edit(s.document);
  ASSERT_TRUE(task);
  EXPECT_EQ(task->title(), "Simplifying to 64 faces");
  task->perform(nullptr);
  task->finish(s.document);
  simplify::SimplifyOptions same = options_of(settings, s.document.edits.last->diagonal);
  same.target_faces = 64;
  EXPECT_TRUE(is_same(s.document.model.mesh,
                      simplify::simplify(build_mesh(test::grid(6)).mesh, same).mesh));
}

TEST(Edits, EditUsesSettingsAtTimeOfRequest) {
  Session early = session_with(test::grid(6));
  early.document.simplify.rules.cost = simplify::CostPolicy::random;
  request_remove_tenth(early.document);
  early.document.simplify.rules.cost = simplify::CostPolicy::quadric;
  run_waiting_edits(early.document);
  Session steady = session_with(test::grid(6));
  steady.document.simplify.rules.cost = simplify::CostPolicy::random;
  request_remove_tenth(steady.document);
  run_waiting_edits(steady.document);
  EXPECT_TRUE(is_same(early.document.model.mesh, steady.document.model.mesh));
  Session other = session_with(test::grid(6));
  request_remove_tenth(other.document);
  run_waiting_edits(other.document);
  EXPECT_FALSE(is_same(early.document.model.mesh, other.document.model.mesh));
}

TEST(Edits, CrossedSeamsGiveNoticeAndUndoRestoresAttributes) {
  Session s = session_with(test::grid(6));
  CornerAttributes a;
  const Mesh& mesh = s.document.model.mesh;
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    a.texcoord.emplace_back(static_cast<float>(i), 0.0F);  // all seams
    a.color.push_back({static_cast<std::uint8_t>(mesh.origin(Halfedge(i)).index()), 0, 0, 255});
  }
  s.document.model.attributes = to_wedges(mesh, std::move(a));
  press(s, "d");
  EXPECT_EQ(test::corners_of(s.document.model).texcoord.size(), mesh.halfedge_count());
  EXPECT_EQ(test::corners_of(s.document.model).color.size(), mesh.halfedge_count());
  test::expect_valid_attributes(s.document.model);
  EXPECT_NE(s.document.notice.find("seams"), std::string::npos) << s.document.notice;
  press(s, "ctrl+z");
  ASSERT_EQ(test::corners_of(s.document.model).texcoord.size(), mesh.halfedge_count());
  EXPECT_EQ(test::corners_of(s.document.model).texcoord[17].x, 17.0F);
}

TEST(Edits, EmptyModelGivesANotice) {
  Session s = session_with({});
  press(s, "d shift+d");
  EXPECT_EQ(s.document.notice, "there is nothing to simplify");
}

TEST(Edits, OpeningModelClearsHistory) {
  Session s = session_with(test::torus(12, 10));
  press(s, "d");
  Model model;
  model.mesh = build_mesh(test::cube()).mesh;
  show_model(s, std::move(model), "cube.obj");
  EXPECT_EQ(s.document.edits.history.undo_depth(), 0U);
  EXPECT_EQ(s.document.edits.opened, nullptr);
  EXPECT_EQ(s.document.edits.opened_faces, 12U);
  EXPECT_FALSE(s.document.edits.last);
}

TEST(Edits, ErrorsAreInPercentOfTheOpenedModelsDiagonal) {
  Session s = session_with(test::cube());
  const double diagonal = s.document.statistics.box.diagonal();
  press(s, "s s");
  ASSERT_LT(s.document.statistics.box.diagonal(), 0.95 * diagonal) << "Loop shrinks the cube";
  press(s, "d");
  ASSERT_TRUE(s.document.edits.last);
  EXPECT_EQ(s.document.edits.last->diagonal, diagonal);
}

TEST(Edits, ReportBelongsToItsModelOnly) {
  Session s = session_with(test::torus(12, 10));
  const Edits& edits = s.document.edits;
  const auto is_shown = [&] { return edits.simplification_outcome() != nullptr; };
  EXPECT_FALSE(is_shown());
  press(s, "d");
  EXPECT_TRUE(is_shown());
  press(s, "ctrl+z");
  EXPECT_FALSE(is_shown()) << "the opened model is not the result";
  press(s, "ctrl+y");
  EXPECT_TRUE(is_shown());
  press(s, "s");
  EXPECT_FALSE(is_shown());
}

TEST(Edits, ReportsOfEarlierStatesAreShownAgain) {
  Session s = session_with(test::torus(12, 10));
  const Edits& edits = s.document.edits;
  const auto faces = [&] {
    const SimplifyOutcome* outcome = edits.simplification_outcome();
    return outcome != nullptr ? outcome->report.faces_reached : 0;
  };
  press(s, "d d s");
  EXPECT_EQ(faces(), 0U);
  ASSERT_NE(edits.subdivision_outcome(), nullptr);
  EXPECT_EQ(edits.subdivision_outcome()->level, 1U);
  press(s, "ctrl+z");
  EXPECT_EQ(faces(), 194U);
  EXPECT_EQ(edits.subdivision_outcome(), nullptr);
  press(s, "ctrl+z");
  EXPECT_EQ(faces(), 216U);
  press(s, "ctrl+y");
  EXPECT_EQ(faces(), 194U);
  press(s, "ctrl+z ctrl+z");
  EXPECT_EQ(faces(), 0U);
  press(s, "shift+d");
  EXPECT_EQ(faces(), 238U);
  EXPECT_EQ(edits.outcomes.size(), 1U) << "the undone edits are gone";
}

TEST(Edits, NamesOfStepsHoldValues) {
  Session s = session_with(test::torus(12, 10));
  press(s, "d shift+d");
  s.document.simplify.max_error_percent = 0.5F;
  simplify_to(s, 0);
  press(s, "s shift+s");
  std::vector<std::string> names;
  for (const HistoryStep& step : s.document.edits.history.steps())
    names.push_back(step.name);
  const std::uint32_t faces = s.document.edits.last->report.faces_reached;
  EXPECT_EQ(names,
            (std::vector<std::string>{"remove 10 % of faces -> 216", "collapse an edge -> 214",
                                      "simplify to error 0.5 % -> " + count_text(faces),
                                      "subdivide to level 1 -> " + count_text(4 * faces),
                                      "back to level 0 -> " + count_text(faces)}));
}

TEST(Edits, ErrorAloneLimitsSimplification) {
  Session s = session_with_cactus();
  s.document.simplify.max_error_percent = 1.0F;
  simplify_to(s, 0);
  const simplify::SimplifyReport& report = s.document.edits.last->report;
  EXPECT_EQ(report.faces_asked, 0U);
  EXPECT_EQ(report.reason, simplify::StopReason::error_bound);
  EXPECT_LT(report.faces_reached, report.faces_before);
  EXPECT_EQ(s.document.edits.history.steps()[0].text.find("faces="), std::string::npos);
}

TEST(Edits, HistoryStepsAreReachedFromEverywhere) {
  Session s = session_with(test::torus(12, 10));
  std::vector<std::uint32_t> faces{s.document.statistics.faces};
  for (const char* key : {"d", "s", "d"}) {
    press(s, key);
    faces.push_back(s.document.statistics.faces);
  }
  for (const std::size_t step : {0, 3, 1, 2, 2, 0, 3}) {
    request_history_step(s.document, step);
    run_waiting_edits(s.document);
    EXPECT_EQ(s.document.statistics.faces, faces[step]);
    EXPECT_EQ(s.document.edits.history.done_steps(), step);
    expect_consistent(s);
  }
  request_history_step(s.document, 99);
  run_waiting_edits(s.document);
  EXPECT_EQ(s.document.edits.history.done_steps(), 3U) << "there are no more";
}

TEST(Edits, CanceledEditThrows) {
  Session s = session_with(test::torus(12, 10));
  request_remove_tenth(s.document);
  const auto task = start_next_edit(s.document);
  Progress progress;
  progress.cancel();
  EXPECT_THROW(task->perform(&progress), Cancelled);
}

TEST(Edits, HaveOneProgress) {
  Session s = session_with(test::torus(260, 200));
  const auto expect_progress = [&](const std::vector<std::string>& stages) {
    const auto task = start_next_edit(s.document);
    test::expect_one_progress(test::watched([&](Progress* progress) { task->perform(progress); }),
                              stages);
    task->finish(s.document);
  };
  request_remove_tenth(s.document);
  expect_progress({"simplifying", "preparing", "simplifying", "finishing", "recording"});
  request_simplify_to(s.document, 20'000);
  expect_progress({"simplifying", "preparing", "simplifying", "finishing", "recording"});
  run(s, "subdivide");
  expect_progress({"subdividing, level 1 of 1", "recording"});
  run(s, "toggle_progressive");
  expect_progress({"simplifying", "preparing", "simplifying", "finishing", "recording",
                   "preparing geomorphs", "measuring levels"});
}

TEST(Edits, CanceledEditLeavesTheDocument) {
  Session s = session_with(test::torus(500, 400));
  const Mesh before = s.document.model.mesh;
  const std::vector<std::pair<const char*, void (*)(Session&)>> edits{
      {"simplifying", [](Session& session) { request_simplify_to(session.document, 500); }},
      {"subdividing", [](Session& session) { run(session, "subdivide"); }},
      {"building a progressive mesh",
       [](Session& session) { run(session, "toggle_progressive"); }}};
  for (const auto& [name, request] : edits) {
    const auto perform = [&, request = request](Progress* progress) {
      request(s);
      const auto task = start_next_edit(s.document);
      task->perform(progress);
    };
    test::cancel_at_many_moments(name, perform, [&] {
      EXPECT_TRUE(test::is_identical(s.document.model.mesh, before));
      EXPECT_EQ(s.document.edits.history.done_steps(), 0U);
      EXPECT_FALSE(s.document.progressive.has_mesh());
    });
  }
}

}  // namespace
}  // namespace mesher::app
