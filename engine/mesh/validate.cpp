#include "engine/mesh/validate.h"
