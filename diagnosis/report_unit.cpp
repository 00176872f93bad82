#include "diagnosis/report_unit.h"

#include "sim/core/units.h"

namespace rollrig::diagnosis {

ReportUnit find_report_unit(const PreparedSet& set, const std::string& channel) {
  if (channel == "drum_torque_Nm") return {"N", set.context().surface_curvature_per_m};
  const Unit unit = unit_of_key(channel);
  return {unit.symbol, 1.0 / unit.factor};
}

}  // namespace rollrig::diagnosis
