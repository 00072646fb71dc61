#include "engine/io/read.h"
