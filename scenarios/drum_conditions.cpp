#include "scenarios/drum_conditions.h"

namespace rollrig::scenarios {
namespace {

InputError missing_condition(const RunSpec& spec, const char* key) {
  InputProblem problem;
  problem.what =
      fmt::format("'{}' is not given, and tire '{}' has no table [iso_28580] to take it from", key, spec.tire.name);
  problem.file = spec.tire.path;
  problem.key = key;
  problem.allowed = fmt::format("--set {}=..., or a table [iso_28580] in the tire file", key);
  return InputError(problem);
}

}  // namespace

void DrumConditions::complete(const RunSpec& spec) {
  const auto& reference = spec.tire.iso_28580;
  if (!load_N.has_value()) {
    if (!reference.has_value()) throw missing_condition(spec, "load_N");
    load_N = reference->load_N;
  }
  if (!pressure_Pa.has_value()) {
    if (!reference.has_value()) throw missing_condition(spec, "pressure_kPa");
    pressure_Pa = reference->pressure_Pa;
  }
  if (!ambient_K.has_value()) ambient_K = spec.rig.environment.ambient_K;
  if (!initial_tire_K.has_value()) initial_tire_K = ambient_K;
}

}  // namespace rollrig::scenarios
