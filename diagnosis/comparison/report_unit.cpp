#include "diagnosis/comparison/report_unit.h"

#include "diagnosis/kinds/measurement_kind.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {

ReportUnit find_report_unit(const PreparedSet& set, const Quantity& channel, std::size_t machine) {
  const measurements::MeasurementSet& source = set.source(machine);
  if (channel == source.kind->traits.force) return {"N", set.kind().force_channel(source).newtons_per_SI};
  const Unit unit = channel.file_unit();
  return {unit.symbol, 1.0 / unit.factor};
}

}  // namespace rollrig::diagnosis
