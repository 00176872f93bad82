#pragma once
/// In which unit a report says how far a channel is off.

#include <string>

#include "diagnosis/comparison/prepared_set.h"

namespace rollrig::diagnosis {

/// Unit of a difference: the channel's own, but for a torque, which is given as force at the drum's surface.
struct ReportUnit {
  std::string symbol;
  double per_SI = 1.0;
};

ReportUnit find_report_unit(const PreparedSet& set, const Quantity& channel, std::size_t machine = 0);

}  // namespace rollrig::diagnosis
