#pragma once
/// What is thrown: all folders use the same types. Installed is the file itself in this one's place.

#include "../../sim/core/error.h"
