// Draws a picture of a model, without a window.
#include <mesher/mesher.h>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  try {
    mesher::Renderer renderer;
    const mesher::Picture picture = renderer.render(
        mesher::Asset::load(argv[1]),
        {.width = 320, .height = 240, .shading = mesher::Shading::gouraud, .wireframe = true});
    picture.save("picture.png");
    std::cout << "drawn by " << renderer.device() << '\n';
  } catch (const mesher::DeviceError& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
