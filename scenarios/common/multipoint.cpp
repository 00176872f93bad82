#include "scenarios/common/multipoint.h"

namespace rollrig::scenarios {
namespace {

constexpr double kBaseAboveIsoPressure_Pa = 30e3;  // Assumed: 210 and 250 kPa of ISO 28580 against 240 and 280 kPa

/// The load of the index, or that of the ISO test over its share of it in class C1.
double find_maximum_load_N(const RunSpec& spec) {
  const models::TireFile& tire = spec.tire;
  if (tire.service.has_value()) return tire.service->load_capacity_N();
  if (tire.iso_28580.has_value()) return tire.iso_28580->load_N / models::find_iso_load_share(models::TireClass::kC1);
  throw InputError(
      {fmt::format("the maximum load is not given, and tire '{}' has neither a table [service_description] nor "
                   "[iso_28580] to take it from",
                   tire.name),
       tire.path, 0, "maximum_load_N", "",
       "--set maximum_load_N=..., or a table [service_description] in the tire file", ""});
}

}  // namespace

void MultipointSettings::complete(const RunSpec& spec) {
  constexpr double kClassC1_s = 1800.0;  // as of CycleSettings
  if (!maximum_load_N.has_value()) maximum_load_N = find_maximum_load_N(spec);
  if (!conditions.pressure_Pa.has_value()) {
    conditions.pressure_Pa = find_default_pressure_Pa(spec) + kBaseAboveIsoPressure_Pa;
  }
  if (loads.size() != pressures_Pa.size()) {
    throw InputError(setting_problem(
        spec, "pressures_above_base_kPa",
        fmt::format("{} loads, but {} pressures: each test point has one of each", loads.size(), pressures_Pa.size()),
        "as many as loads_percent"));
  }
  constexpr double kLeast_Pa = 50e3;  // as of a pressure that is set
  for (const TestPoint& point : list_points()) {
    check_test_load(spec, "loads_percent", point.load_N);
    if (point.pressure_Pa >= kLeast_Pa) continue;
    throw InputError(setting_problem(spec, "pressures_above_base_kPa",
                                     fmt::format("a test point has a pressure of {:.4g} kPa", point.pressure_Pa / 1e3),
                                     "at least 50 kPa, base pressure and difference together"));
  }
  const auto& iso = spec.tire.iso_28580;
  if (!warm_up_s.has_value() && iso.has_value()) warm_up_s = iso->warm_up_s;
  if (!warm_up_s.has_value()) warm_up_s = kClassC1_s;
  conditions.load_N = list_points().front().load_N;
  conditions.complete(spec);
}

std::vector<TestPoint> MultipointSettings::list_points() const {
  std::vector<TestPoint> points;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    points.push_back({loads[i] * *maximum_load_N, *conditions.pressure_Pa + pressures_Pa[i]});
  }
  return points;
}

estimation::ReferenceCondition MultipointSettings::make_reference() const {
  return estimation::make_standard_reference(*maximum_load_N, *conditions.pressure_Pa);
}

estimation::RollingPoint RollingStep::to_point() const {
  return {cycle.loaded.speed_m_s, cycle.loaded.load_N, pressure_set_Pa, cycle.rolling_resistance_N};
}

}  // namespace rollrig::scenarios
