#include "app/cli/run.h"

int main(int argc, char** argv) {
  return mesher::app::run(argc, argv);
}
