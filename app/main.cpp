#include <csignal>

#include "app/cli/run.h"

int main(int argc, char** argv) {
  // Writing beyond a file size limit or into a closed pipe then gives an error message instead of
  // ending the program silently.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  return mesher::app::run(argc, argv);
}
