#pragma once

#include "app/commands.h"

namespace mesher::app {

/// Runs a command on how a progressive mesh is looked at; where none is, the notice says how to
/// get one. Pre: it is one of those.
void run_progressive(Session& session, Command command);

}  // namespace mesher::app
