#include "engine/io/write.h"
