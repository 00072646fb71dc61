// Reads a model, says what had to be repaired, and writes it in another format.
#include <mesher/mesher.h>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: " << argv[0] << " MODEL\n";
    return 1;
  }
  try {
    const mesher::Asset model = mesher::Asset::load(argv[1]);
    for (const mesher::RepairCount& repair : model.repairs())
      std::cout << "repaired: " << repair.text << '\n';

    const mesher::MeshStatistics s = model.statistics();
    std::cout << s.vertices << " vertices, " << s.faces << " faces, " << s.boundary_loops
              << " boundary loops, diagonal " << s.diagonal << '\n';

    for (const std::string& loss : model.save("model.ply"))
      std::cout << "model.ply does not hold " << loss << '\n';
  } catch (const mesher::InputError& error) {
    std::cerr << error.file() << ", line " << error.line() << ": " << error.reason() << '\n';
    return 2;
  } catch (const mesher::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.exit_code());
  }
}
