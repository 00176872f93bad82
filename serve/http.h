#pragma once
/// cpp-httplib without the macros of the system's headers that it lets in.

#include <httplib.h>

#undef si_value  // of <signal.h>, and a name of sim/core/units.h
#undef _res      // of <resolv.h>, and a name of Eigen's
