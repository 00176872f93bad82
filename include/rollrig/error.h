#pragma once
/// What is thrown: all folders use the same types. Installing replaces this file by sim/core/error.h.

#include "../../sim/core/error.h"
