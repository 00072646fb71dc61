#include "engine/mesh/build.h"
