// Subdivides a model twice by Loop's scheme, with its sharp edges as creases, onto the limit
// surface.
#include <mesher/mesher.h>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  mesher::Asset model = mesher::Asset::load(argv[1]);
  model.tag_creases(60.0F);
  const mesher::Asset smooth = model.subdivide({.levels = 2, .limit = true});
  smooth.save("smooth.glb");
  std::cout << model.face_count() << " faces became " << smooth.face_count() << '\n';
  return smooth.face_count() == 16 * model.face_count() ? 0 : 1;
}
