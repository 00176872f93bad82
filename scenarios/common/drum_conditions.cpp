#include "scenarios/common/drum_conditions.h"

namespace rollrig::scenarios {
namespace {

InputError missing_condition(const RunSpec& spec, const char* key) {
  return InputError(
      {fmt::format("'{}' is not given, and tire '{}' has no table [iso_28580] to take it from", key, spec.tire.name),
       spec.tire.path, 0, key, "", fmt::format("--set {}=..., or a table [iso_28580] in the tire file", key), ""});
}

void refuse_load(const RunSpec& spec, const char* key, double load_N, const std::string& what,
                 const std::string& allowed) {
  InputProblem problem = setting_problem(spec, key, what, allowed);
  if (problem.file.empty()) problem.file = spec.tire.path;  // the tire's own load
  problem.value = fmt::format("{}", load_N);
  throw InputError(problem);
}

}  // namespace

double calc_skim_limit_N(const rigs::RigFile& rig) { return 1.5 * rig.skim.load_N; }

void check_tire_carries(const RunSpec& spec, const char* key, double load_N) {
  if (!spec.tire.has_stiffness) return;
  const models::TireGeometry<double>& geometry = spec.tire.values.geometry;
  const double sidewall_m = (geometry.outer_diameter_m - geometry.rim_diameter_m) / 2.0;
  const double most_N = spec.tire.values.stiffness.vertical_N_per_m * sidewall_m;
  if (load_N < most_N) return;
  refuse_load(spec, key, load_N, fmt::format("a load of {} N presses tire '{}' onto its rim", load_N, spec.tire.name),
              fmt::format("less than {:.0f} N (vertical stiffness x height of the sidewall)", most_N));
}

void check_test_load(const RunSpec& spec, const char* key, double load_N) {
  const double skim_limit_N = calc_skim_limit_N(spec.rig);
  if (load_N <= skim_limit_N) {
    refuse_load(spec, key, load_N, fmt::format("a load of {} N counts as skimming on rig '{}'", load_N, spec.rig.name),
                fmt::format("more than {} N (1.5 x the rig's skim load)", skim_limit_N));
  }
  check_tire_carries(spec, key, load_N);
}

double find_default_pressure_Pa(const RunSpec& spec) {
  if (!spec.tire.iso_28580.has_value()) throw missing_condition(spec, "pressure_kPa");
  return spec.tire.iso_28580->pressure_Pa;
}

void DrumConditions::complete(const RunSpec& spec) {
  const auto& reference = spec.tire.iso_28580;
  if (!load_N.has_value()) {
    if (!reference.has_value()) throw missing_condition(spec, "load_N");
    load_N = reference->load_N;
  }
  check_test_load(spec, "load_N", *load_N);
  if (!pressure_Pa.has_value()) pressure_Pa = find_default_pressure_Pa(spec);
  if (!ambient_K.has_value()) ambient_K = spec.rig.environment.ambient_K;
  if (!initial_tire_K.has_value()) initial_tire_K = ambient_K;
}

void CycleSettings::complete(const RunSpec& spec) {
  constexpr double kClassC1_s = 1800.0;  // §3.2.1 item 7
  const auto& iso = spec.tire.iso_28580;
  if (!warm_up_s.has_value() && iso.has_value()) warm_up_s = iso->warm_up_s;
  if (!warm_up_s.has_value()) warm_up_s = kClassC1_s;
  conditions.complete(spec);
}

void complete_as_on_vehicle(DrumConditions& conditions, const RunSpec& spec) {
  const auto& validity = spec.tire.validity;
  const bool is_of_car = !validity.has_value() || validity->lowest_load_N <= kVehicleLoad_N * (1.0 + 1e-9);
  if (!is_of_car) return;
  if (!conditions.load_N.has_value()) conditions.load_N = kVehicleLoad_N;
  if (!conditions.pressure_Pa.has_value()) conditions.pressure_Pa = kVehiclePressure_Pa;
}

}  // namespace rollrig::scenarios
