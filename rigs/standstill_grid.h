#pragma once
/// The fixed grid of the quasi-static rigs near standstill.

#include <cstddef>

#include "sim/program.h"

namespace rollrig::rigs {

/// The same program with its segments cut where the speed enters or leaves the band around standstill in
/// which forces fade (tanh(v / 0.05 m/s)), and a grid fine enough for the fade inside it. `speed_input` is the index
/// of the speed among the inputs.
sim::Program refine_near_standstill(sim::Program program, std::size_t speed_input);

}  // namespace rollrig::rigs
