// Measures how far a simplified model is from the original.
#include <mesher/mesher.h>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  const mesher::Asset model = mesher::Asset::load(argv[1]);
  const mesher::Asset coarse = model.simplify({.target_faces = model.face_count() / 4});
  const mesher::Comparison distance = model.compare(coarse, {.samples = 20'000});
  std::cout << "rms " << 100.0 * distance.rms / distance.diagonal << " %, max at most "
            << 100.0 * distance.upper_bound / distance.diagonal << " % of the diagonal\n";
  return distance.max <= distance.upper_bound ? 0 : 1;
}
