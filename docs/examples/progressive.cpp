// Moves through the levels of detail of a model, as a program with a GPU would.
#include <mesher/mesher.h>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  mesher::ProgressiveMesh levels(mesher::Asset::load(argv[1]));
  levels.save("levels.pm", 14);

  levels.set_level(0);
  levels.take_changes();  // here the GPU gets both arrays whole
  std::cout << "base: " << levels.indices().size() / 3 << " faces\n";

  levels.refine();  // one vertex split
  for (const mesher::ElementRange& range : levels.take_changes().indices)
    std::cout << "upload the indices from " << range.begin << " to " << range.end << '\n';

  levels.set_face_count(500);
  levels.current().save("level.obj");

  const mesher::ProgressiveMesh read = mesher::ProgressiveMesh::load("levels.pm");
  std::cout << "from the file: " << read.level_count() << " splits\n";
  return read.level_count() == levels.level_count() && read.damage().empty() ? 0 : 1;
}
