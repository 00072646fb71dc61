#include "engine/mesh/triangulate.h"
