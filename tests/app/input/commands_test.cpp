#include "app/input/commands.h"

#include <gtest/gtest.h>

#include <set>

#include "app/edit/edits.h"
#include "tests/support/meshes.h"

namespace mesher::app {
namespace {

using render::Shading;

Session session_with_cube() {
  Session session;
  Model model;
  model.name = "cube.obj";
  model.mesh = build_mesh(test::cube()).mesh;
  show_model(session, std::move(model), "cube.obj");
  return session;
}

void press_keys(Session& session, const char* keys) {
  for (const KeyPress& key : parse_keys(keys)) {
    const auto command = command_for(key);
    ASSERT_NE(command, nullptr) << to_text(key);
    run(session, *command);
  }
}

TEST(Commands, NoKeyIsBoundTwice) {
  std::set<std::string> seen;
  for (const Command& command : commands()) {
    for (const KeyPress& key : parse_keys(command.keys)) {
      EXPECT_TRUE(seen.insert(to_text(key)).second) << to_text(key);
    }
  }
  EXPECT_EQ(command_for({"f9", false, false}), nullptr);
  EXPECT_EQ(command_for({"g", false, true}), nullptr);
}

TEST(Commands, EachHasUniqueIdAndHelpText) {
  std::set<std::string> ids;
  for (const Command& command : commands()) {
    EXPECT_TRUE(ids.insert(command.id).second) << command.id;
    EXPECT_EQ(command_named(command.id), &command);
    EXPECT_NE(std::string(command.help), "") << command.id;
    EXPECT_NE(std::string(command.label), "") << command.id;
    EXPECT_TRUE(std::visit([](auto* function) { return function != nullptr; }, command.function))
        << command.id;
    EXPECT_EQ(command_for(parse_keys(command.keys).front()), &command) << command.id;
  }
  EXPECT_EQ(command_named("no_such_command"), nullptr);
}

TEST(Commands, BlockedCommandGivesNoticeAndChangesNothing) {
  Session s = session_with_cube();
  int refused = 0;
  for (const Command& command : commands()) {
    if (command.blocked == nullptr) continue;
    const char* reason = blocked(s, command);
    if (reason == nullptr) continue;
    ++refused;
    run(s, command);
    EXPECT_EQ(s.document.notice, reason) << command.id;
    EXPECT_FALSE(s.document.progressive.is_playing());
    EXPECT_TRUE(s.document.edits.waiting.empty());
  }
  EXPECT_EQ(blocked(s, *command_named("play")),
            std::string("press P first: this key works in progressive mode"));
  EXPECT_EQ(blocked(s, *command_named("undo")), std::string("nothing to undo"));
  EXPECT_EQ(blocked(s, *command_named("simplify")), nullptr);
  EXPECT_GE(refused, 14);
}

TEST(Commands, SearchFindsByEveryWord) {
  const auto first = [](const char* filter) {
    const auto found = matching_commands(filter);
    return found.empty() ? std::string() : std::string(found.front()->id);
  };
  EXPECT_EQ(first("gour"), "toggle_gouraud");
  EXPECT_EQ(first("COMMAND line copy"), "copy_command_line");
  EXPECT_EQ(first("ctrl+z"), "undo");
  EXPECT_EQ(first("no such thing"), "");
  EXPECT_EQ(matching_commands("").size(), commands().size());
}

TEST(Commands, ToolsTurnCreaseModeOnAndOff) {
  Session s = session_with_cube();
  press_keys(s, "ctrl+5");
  EXPECT_EQ(s.tool, Tool::creases);
  EXPECT_TRUE(s.document.creases.is_on);
  press_keys(s, "tab ctrl+4");
  EXPECT_EQ(s.tool, Tool::subdivide);
  EXPECT_FALSE(s.document.creases.is_on);
  EXPECT_TRUE(s.shows_info);
}

TEST(Commands, UndoWaitsForEditsThatAreRequested) {
  Session s = session_with_cube();
  press_keys(s, "d ctrl+z");
  run_waiting_edits(s.document);
  EXPECT_EQ(s.document.edits.history.redo_depth(), 1U);
}

TEST(Commands, WTogglesWireframe) {
  Session s = session_with_cube();
  EXPECT_FALSE(s.view.settings.wireframe);
  press_keys(s, "w");
  EXPECT_TRUE(s.view.settings.wireframe);
  EXPECT_EQ(s.view.settings.shading, Shading::flat);
  press_keys(s, "w");
  EXPECT_FALSE(s.view.settings.wireframe);
}

TEST(Commands, GTogglesGouraud) {
  Session s = session_with_cube();
  press_keys(s, "g");
  EXPECT_EQ(s.view.settings.shading, Shading::gouraud);
  press_keys(s, "g");
  EXPECT_EQ(s.view.settings.shading, Shading::flat);
}

TEST(Commands, NGoesThroughTheWeightsOfNormals) {
  Session s = session_with_cube();
  const NormalWeight first = s.view.settings.normal_weight;
  EXPECT_EQ(first, NormalWeight::angle);
  press_keys(s, "n");
  EXPECT_EQ(s.view.settings.normal_weight, NormalWeight::area);
  press_keys(s, "n n");
  EXPECT_EQ(s.view.settings.normal_weight, first);
}

TEST(Commands, SurfaceOrWireframeIsAlwaysShown) {
  Session s = session_with_cube();
  press_keys(s, "shift+w");
  EXPECT_EQ(s.view.settings.shading, Shading::none);
  EXPECT_TRUE(s.view.settings.wireframe);
  press_keys(s, "w");  // hides the wireframe, so the surface is shown again
  EXPECT_FALSE(s.view.settings.wireframe);
  EXPECT_EQ(s.view.settings.shading, Shading::flat);
  press_keys(s, "shift+w shift+w");
  EXPECT_EQ(s.view.settings.shading, Shading::flat);
}

TEST(Commands, ViewKeysLookAlongAxes) {
  Session s = session_with_cube();
  press_keys(s, "1");
  EXPECT_NEAR(s.view.camera.forward().z, -1.0, 1e-12);
  press_keys(s, "3");
  EXPECT_NEAR(s.view.camera.forward().x, -1.0, 1e-12);
  press_keys(s, "7");
  EXPECT_NEAR(s.view.camera.forward().y, -1.0, 1e-12);
  press_keys(s, "5");
  EXPECT_TRUE(s.view.camera.is_orthographic());
  press_keys(s, "5");
  EXPECT_FALSE(s.view.camera.is_orthographic());
}

TEST(Commands, FFramesModel) {
  Session s = session_with_cube();
  const render::Camera before = s.view.camera;
  s.view.camera.zoom(7.0);
  s.view.camera.pan({200, 100}, s.view.window);
  EXPECT_FALSE(before == s.view.camera);
  press_keys(s, "f");
  EXPECT_NEAR(s.view.camera.distance(), before.distance(), 1e-12);
  EXPECT_EQ(s.view.camera.pivot(), before.pivot());
}

TEST(Commands, HelpHasThreeKeys) {
  for (const char* key : {"f1", "h", "?"}) {
    Session s = session_with_cube();
    press_keys(s, key);
    EXPECT_TRUE(s.shows_help) << key;
  }
}

TEST(Commands, EscapeClosesInnermostFirst) {
  Session s = session_with_cube();
  s.document.error = "bad file";
  press_keys(s, "h ctrl+o");
  press_keys(s, "esc");
  EXPECT_FALSE(s.open_dialog.is_shown);
  EXPECT_TRUE(s.shows_help);
  press_keys(s, "esc");
  EXPECT_FALSE(s.shows_help);
  EXPECT_FALSE(s.document.error.empty());
  press_keys(s, "esc");
  EXPECT_TRUE(s.document.error.empty());
  EXPECT_FALSE(s.wants_quit);
  press_keys(s, "esc");
  EXPECT_FALSE(s.wants_quit) << "Escape never quits";
}

TEST(Commands, PanelBackgroundScreenshotAndQuitKeysWork) {
  Session s = session_with_cube();
  press_keys(s, "tab b f12");
  EXPECT_FALSE(s.shows_info);
  EXPECT_EQ(s.view.settings.background, render::Background::dark);
  EXPECT_TRUE(s.wants_screenshot);
  EXPECT_FALSE(s.wants_quit);
  press_keys(s, "q");
  EXPECT_TRUE(s.wants_quit);
}

TEST(Commands, EditsAreQueuedInOrder) {
  Session s = session_with_cube();
  press_keys(s, "d shift+d ctrl+z ctrl+shift+z ctrl+y");
  ASSERT_EQ(s.document.edits.waiting.size(), 5U);
  EXPECT_EQ(s.document.statistics.faces, 12U);
  const char* expected[] = {"Simplifying to 10 faces", "Collapsing an edge"};
  for (const char* title : expected) {
    const auto task = start_next_edit(s.document);
    ASSERT_TRUE(task);
    EXPECT_EQ(task->title(), title);
    task->perform(nullptr);
    task->finish(s.document);
  }
  EXPECT_EQ(s.document.edits.history.undo_depth(), 2U);
  EXPECT_FALSE(start_next_edit(s.document));  // an undo is finished at once
  EXPECT_EQ(s.document.edits.history.undo_depth(), 1U);
  EXPECT_FALSE(start_next_edit(s.document));
  EXPECT_EQ(s.document.edits.history.undo_depth(), 2U);
  EXPECT_FALSE(start_next_edit(s.document));
  EXPECT_EQ(s.document.notice, "nothing to redo");
}

TEST(Session, ShowModelCountsAndFramesIt) {
  Session s = session_with_cube();
  EXPECT_EQ(s.document.statistics.faces, 12U);
  EXPECT_EQ(s.document.model_generation, 1U);
  EXPECT_EQ(s.view.camera.pivot(), glm::dvec3(0.0));
  EXPECT_GT(s.view.camera.distance(), 1.0);
}

void run_to_the_end(Session& session, const Command& command) {
  run(session, command);
  run_waiting_edits(session.document);
}

TEST(Commands, MarkOfEachToggleFlips) {
  int toggles = 0;
  for (const Command& command : commands()) {
    SCOPED_TRACE(command.id);
    if (!std::string_view(command.id).starts_with("toggle_")) continue;
    // Between two rules, neither of which is on or off.
    if (std::string_view(command.id) == "toggle_crease_rules") continue;
    ASSERT_NE(command.is_on, nullptr);
    Session s = session_with_cube();
    if (blocked(s, command) != nullptr) run_to_the_end(s, *command_named("toggle_progressive"));
    ASSERT_EQ(blocked(s, command), nullptr);
    const bool was_on = is_on(s, command);
    run_to_the_end(s, command);
    EXPECT_EQ(is_on(s, command), !was_on);
    run_to_the_end(s, command);
    EXPECT_EQ(is_on(s, command), was_on);
    ++toggles;
  }
  EXPECT_GE(toggles, 13);
}

TEST(Commands, ShownToolIsMarked) {
  Session s = session_with_cube();
  for (const Command& tool : commands()) {
    if (!std::string_view(tool.id).starts_with("tool_")) continue;
    run(s, tool);
    for (const Command& other : commands()) {
      if (std::string_view(other.id).starts_with("tool_")) {
        EXPECT_EQ(is_on(s, other), &other == &tool) << tool.id << ", " << other.id;
      }
    }
  }
  run(s, "toggle_info");
  EXPECT_FALSE(is_on(s, *command_named("tool_levels"))) << "no panel is shown";
  EXPECT_FALSE(is_on(s, *command_named("quit"))) << "not a toggle";
}

}  // namespace
}  // namespace mesher::app
