#pragma once

namespace mesher::app {

/// The program: reads the command line, runs one command, and turns every failure into one line on
/// stderr and the exit code that ExitCode documents.
int run(int argc, const char* const* argv);

}  // namespace mesher::app
