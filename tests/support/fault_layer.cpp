#include "tests/support/fault_layer.h"

#include <fstream>
#include <stdexcept>

namespace mesher::test {

FaultLayer::FaultLayer() {
  if (!std::filesystem::exists(MESHER_FAULT_LAYER "/fault_layer.json"))
    throw std::runtime_error("the layer of faults was not built");
}

std::vector<std::string> FaultLayer::environment() const {
  return {"VK_ADD_LAYER_PATH=" MESHER_FAULT_LAYER, "VK_INSTANCE_LAYERS=VK_LAYER_MESHER_faults",
          "MESHER_FAULT_CUE=" + file().string()};
}

void FaultLayer::cue(const std::vector<Cue>& cues) const {
  // The program must not read half of it.
  std::ofstream out(folder_ / "next");
  for (const Cue& cue : cues)
    out << cue.call << ' ' << static_cast<int>(cue.result) << ' ' << cue.count << ' '
        << cue.least_bytes << '\n';
  out.close();
  std::filesystem::rename(folder_ / "next", file());
}

}  // namespace mesher::test
