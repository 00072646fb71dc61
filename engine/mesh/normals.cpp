#include "engine/mesh/normals.h"
