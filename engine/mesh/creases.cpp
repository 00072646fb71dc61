#include "engine/mesh/creases.h"
