#include "engine/mesh/statistics.h"
