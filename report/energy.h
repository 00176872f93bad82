#pragma once
/// The energy balance of a run.

#include "report/page.h"
#include "sim/energy_audit.h"

namespace rollrig::report {

/// Both ledgers of the audit as flows; what the tire loses flows on from the mechanical into the thermal one.
Block make_energy(const sim::EnergyAudit& audit);

}  // namespace rollrig::report
