#pragma once

namespace mesher::app {

/// Runs the program: parses the command line and runs one command. Every failure becomes one line
/// on stderr and one of the exit codes that ExitCode documents.
int run(int argc, const char* const* argv);

}  // namespace mesher::app
