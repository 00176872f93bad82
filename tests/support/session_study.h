#pragma once
/// Coastdowns of several sessions, and what the methods say of them.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "estimation/road_load/road_load_procedure.h"
#include "tests/support/coastdown_study.h"

namespace rollrig::tests {

/// A session for each study, named as said, with seeds one after the other.
estimation::CoastdownData simulate_sessions(const std::vector<std::pair<std::string, CoastdownStudy>>& studies,
                                            std::uint64_t first_seed = 1);

/// Two sessions, the second named "pm".
estimation::CoastdownData join_sessions(const CoastdownStudy& first, const CoastdownStudy& second);

/// The speeds of a session divided by `factor`, as if they were written in another unit.
estimation::CoastdownData with_speeds_over(estimation::CoastdownData data, const std::string& session, double factor);

/// By the default method, with its doubts of runs and records.
estimation::RoadLoadFit fit_checked(const estimation::CoastdownData& data);

/// By SAE J1263.
estimation::RoadLoadProcedure fit_traces(const estimation::CoastdownData& data);

/// By the WLTP.
estimation::RoadLoadProcedure fit_reference_speeds(const estimation::CoastdownData& data);

/// Whether a warning of a fit or a procedure contains the text.
bool has_warning(const std::vector<std::string>& warnings, const std::string& text);
template <class T>
bool has_warning(const T& fit, const std::string& text) {
  return has_warning(fit.warnings, text);
}

/// Whole runs of the WLTP, 138 to 12 km/h, four pairs that scatter.
CoastdownStudy make_whole_runs();

/// The warnings of the default method, of j1263 and of wltp.
std::vector<std::pair<std::string, std::vector<std::string>>> list_warnings_by_method(
    const estimation::CoastdownData& data);

}  // namespace rollrig::tests
