#pragma once

#include <gtest/gtest.h>

#include "app/document/session.h"
#include "app/edit/edits.h"
#include "app/input/commands.h"
#include "engine/mesh/build/build.h"
#include "engine/mesh/delta.h"
#include "tests/support/meshes.h"

namespace mesher::app {

/// A session that shows this model, with nothing left to upload.
inline Session session_with(Soup soup) {
  Session session;
  Model model;
  BuildResult built = build_mesh(std::move(soup));
  model.mesh = std::move(built.mesh);
  model.attributes = std::move(built.attributes);
  show_model(session, std::move(model), "model.obj");
  session.document.model.mesh.changes().clear();
  return session;
}

/// Presses keys in order. Each finishes its edits and leaves a valid mesh.
inline void press(Session& session, const char* keys) {
  for (const KeyPress& key : parse_keys(keys)) {
    run(session, *command_for(key));
    run_waiting_edits(session.document);
    test::expect_valid(session.document.model.mesh);
    EXPECT_EQ(session.document.statistics.faces, session.document.model.mesh.face_count());
  }
}

inline bool is_same(const Mesh& a, const Mesh& b) {
  return difference(a, b).is_empty();
}

}  // namespace mesher::app
