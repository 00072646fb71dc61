// Simplifies a model to a tenth of its faces, watches the work, and says how far the result is off.
#include <mesher/mesher.h>

#include <cstdint>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) return 1;
  const mesher::Asset model = mesher::Asset::load(argv[1]);

  mesher::SimplifyOptions options{.target_faces = model.face_count() / 10, .certify = true};
  options.progress = [](float fraction, std::string_view stage) {
    std::cout << stage << ' ' << int(100.0F * fraction) << " %\n";
    return true;  // false would cancel
  };
  std::uint64_t observed = 0;
  options.collapsed = [&](std::span<const mesher::EdgeCollapse> collapses) {
    observed += collapses.size();
  };

  mesher::SimplifyReport report;
  const mesher::Asset small = model.simplify(options, &report);
  small.save("small.obj");
  std::cout << report.faces_before << " faces became " << report.faces_reached << " by " << observed
            << " collapses; no point is farther off than " << report.certified_bound << '\n';
  return observed == report.collapses && small.face_count() == report.faces_reached ? 0 : 1;
}
