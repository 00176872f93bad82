#pragma once
/// Which rows set the scale of a panel over time, so that a run-up does not flatten the rest.

#include <utility>
#include <vector>

#include "report/page.h"

namespace rollrig::report {

/// Rows that set the scale of a drum's panels: the drum turns at steady speed, and the load has not changed in the last
/// rows. Run-up and the moment of a change of load reach far beyond.
std::vector<bool> find_scale_rows(const std::vector<double>& time_s, const std::vector<double>& load_N,
                                  const std::vector<double>& speed_m_s);

/// A line of a panel, and which of its rows set the scale.
using ScaledLine = std::pair<const std::vector<double>*, const std::vector<bool>*>;

/// Least and greatest value of a panel over the rows that set its scale; null where they are nearly all of it.
Json find_scale(const std::vector<ScaledLine>& lines);

}  // namespace rollrig::report
