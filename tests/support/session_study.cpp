#include "tests/support/session_study.h"

#include <algorithm>

#include "estimation/road_load/checked_road_load.h"

namespace rollrig::tests {
namespace {

using estimation::CoastdownData;
using estimation::CoastdownFile;
using estimation::CoastdownRun;

CoastdownFile to_file(const CoastdownData& data) {
  CoastdownFile file;
  file.data = data;
  file.is_trace = data.runs.front().bins.empty();
  return file;
}

RoadLoadProcedureOptions make_options(RoadLoadProcedureKind kind) {
  RoadLoadProcedureOptions options;
  options.mass_kg = CoastdownStudy().mass_kg;
  options.rotating_mass_kg = CoastdownStudy().effective_mass_kg - CoastdownStudy().mass_kg;
  options.kind = kind;
  return options;
}

}  // namespace

CoastdownData simulate_sessions(const std::vector<std::pair<std::string, CoastdownStudy>>& studies,
                                std::uint64_t first_seed) {
  CoastdownData data;
  std::uint64_t seed = first_seed;
  for (const auto& [name, study] : studies) {
    for (CoastdownRun& run : simulate_coastdowns(study, seed++).runs) {
      if (!name.empty()) run.session = name;
      data.runs.push_back(std::move(run));
    }
  }
  return data;
}

CoastdownData join_sessions(const CoastdownStudy& first, const CoastdownStudy& second) {
  return simulate_sessions({{"", first}, {"pm", second}});
}

CoastdownData with_speeds_over(CoastdownData data, const std::string& session, double factor) {
  for (CoastdownRun& run : data.runs) {
    if (run.session != session) continue;
    for (double& speed_m_s : run.speed_m_s) speed_m_s /= factor;
  }
  return data;
}

estimation::RoadLoadFit fit_checked(const CoastdownData& data) {
  estimation::RoadLoadFitOptions options;
  options.mass_kg = CoastdownStudy().mass_kg;
  CoastdownFile file = to_file(data);
  return estimation::fit_checked_road_load(file, options);
}

estimation::RoadLoadProcedure fit_traces(const CoastdownData& data) {
  return estimation::evaluate_traces(to_file(data), make_options(RoadLoadProcedureKind::kJ1263));
}

estimation::RoadLoadProcedure fit_reference_speeds(const CoastdownData& data) {
  return estimation::evaluate_wltp_coastdowns(to_file(data), make_options(RoadLoadProcedureKind::kWltp));
}

bool has_warning(const std::vector<std::string>& warnings, const std::string& text) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
}

CoastdownStudy make_whole_runs() {
  CoastdownStudy study;
  study.pairs = 4;
  study.run_force_sd_N = 3.0;
  study.run_wind_sd_m_s = 0.2;
  study.from_km_h = 138.0;
  study.to_km_h = 12.0;
  return study;
}

std::vector<std::pair<std::string, std::vector<std::string>>> list_warnings_by_method(const CoastdownData& data) {
  return {{"bins", fit_checked(data).warnings},
          {"j1263", fit_traces(data).warnings},
          {"wltp", fit_reference_speeds(data).warnings}};
}

}  // namespace rollrig::tests
