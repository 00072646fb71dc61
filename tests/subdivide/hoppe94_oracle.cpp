#include "tests/subdivide/hoppe94_oracle.h"

#include <array>

namespace mesher::test {

double hoppe94_sharp_edge(Kind a, Kind b) {
  constexpr double kSmooth = -1.0;
  // The regular end has the weight 5/8.
  constexpr double kToFirst = 3.0 / 8.0;
  constexpr double kToSecond = 5.0 / 8.0;
  constexpr double kMiddle = 1.0 / 2.0;
  // Rows: the first end; columns: the second end. Dart, regular, non-regular, corner.
  constexpr std::array<std::array<double, 4>, 4> kTable{{{kSmooth, kSmooth, kSmooth, kSmooth},
                                                         {kSmooth, kMiddle, kToFirst, kToFirst},
                                                         {kSmooth, kToSecond, kMiddle, kMiddle},
                                                         {kSmooth, kToSecond, kMiddle, kMiddle}}};
  const auto place = [](Kind kind) -> std::size_t {
    switch (kind) {
      case Kind::smooth:  // the end of a sharp edge is never smooth
      case Kind::dart:
        return 0;
      case Kind::regular_crease:
        return 1;
      case Kind::other_crease:
        return 2;
      case Kind::corner:
        return 3;
    }
    return 0;
  };
  return kTable[place(a)][place(b)];
}

}  // namespace mesher::test
