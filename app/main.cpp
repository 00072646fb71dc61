#include <csignal>

#include "app/cli/run.h"

int main(int argc, char** argv) {
  // Writing past a limit or into a closed pipe is then an error with a message, not a silent death.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  return mesher::app::run(argc, argv);
}
