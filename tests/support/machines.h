#pragma once
/// The kinds of machines by name.

#include "rigs/machine.h"

namespace rollrig::tests {

using Machine = const rigs::MachineKind*;

inline const Machine kDrum = &rigs::find_machine_kind("drum");
inline const Machine kFlatBelt = &rigs::find_machine_kind("flat_belt");
inline const Machine kDyno = &rigs::find_machine_kind("dyno");
inline const Machine kRoad = &rigs::find_machine_kind("road");

}  // namespace rollrig::tests
