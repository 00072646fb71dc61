// Writes the man pages and completions of the program into a folder; the build runs it.
#include <fstream>
#include <iostream>

#include "app/cli/completion.h"
#include "app/cli/man_page.h"

namespace {

bool write(const std::string& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  return static_cast<bool>(out.flush());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: " << argv[0] << " FOLDER VERSION\n";
    return 1;
  }
  const std::string folder = std::string(argv[1]) + "/";
  const std::string version = argv[2];
  const mesher::app::CommandTable table = mesher::app::command_table();
  bool is_written = write(folder + "mesher.1", mesher::app::man_page(table, version));
  for (const mesher::app::CommandInfo& command : table.commands) {
    is_written &= write(folder + "mesher-" + command.name + ".1",
                        mesher::app::man_page(table, command, version));
  }
  is_written &= write(folder + "mesher.bash", mesher::app::bash_completion(table));
  is_written &= write(folder + "_mesher", mesher::app::zsh_completion(table));
  is_written &= write(folder + "mesher.fish", mesher::app::fish_completion(table));
  if (!is_written) std::cerr << folder << ": cannot be written\n";
  return is_written ? 0 : 1;
}
