#include "diagnosis/comparison/report_unit.h"

#include "diagnosis/kinds/measurement_kind.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {

ReportUnit find_report_unit(const PreparedSet& set, const std::string& channel) {
  const ForceChannel force = set.kind().force_channel(set.source());
  if (channel == force.name) return {"N", force.newtons_per_SI};
  const Unit unit = unit_of_key(channel);
  return {unit.symbol, 1.0 / unit.factor};
}

}  // namespace rollrig::diagnosis
