#pragma once
/// The energy balance of a run.

#include "report/page.h"
#include "sim/energy_audit.h"

namespace rollrig::report {

/// Both ledgers of the audit, what the tire loses going on as heat.
Block make_energy(const sim::EnergyAudit& audit);

}  // namespace rollrig::report
