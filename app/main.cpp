#include <csignal>

#include "app/cli/run.h"
#include "engine/io/cut_mapping.h"
#include "engine/io/temporary_files.h"

int main(int argc, char** argv) {
  // Writing beyond a file size limit or into a closed pipe then gives an error message instead of
  // ending the program silently.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  mesher::io::remove_temporaries_on_signals();
  mesher::io::survive_cut_mappings();
  return mesher::app::run(argc, argv);
}
