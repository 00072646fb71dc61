#include <mesher/version.h>

namespace mesher {

const char* version() {
  return MESHER_VERSION;
}

}  // namespace mesher
