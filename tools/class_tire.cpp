#include "tools/class_tire.h"

#include <boost/math/tools/roots.hpp>

#include "scenarios/run/run_spec.h"

namespace rollrig::tools {

scenarios::RunSpec make_virtual_test(const std::string& scenario, const char* rig,
                                     const std::vector<std::string>& settings) {
  ConfigTable document = scenarios::make_run_document(scenario);
  set_config_value(document, "tire", "a50", "tools");
  set_config_value(document, "rig", rig, "tools");
  set_config_value(document, "fidelity", "quasi_static", "tools");
  for (const std::string& setting : settings) scenarios::set_run_value(document, setting);
  return scenarios::read_run_spec(document, "");
}

double find_loss_factor(double rrc_N_per_kN) {
  const scenarios::RunSpec plain = make_virtual_test("iso_28580", "drum_2m", {});
  const auto miss = [&](double factor) {
    scenarios::RunSpec spec = plain;
    scale_loss(spec.tire, factor);
    return scenarios::run_scenario(spec, {}).result["rrc_25degC_2m_N_per_kN"].get<double>() - rrc_N_per_kN;
  };
  std::uintmax_t iterations = 60;
  const auto bracket =
      boost::math::tools::toms748_solve(miss, 0.5, 4.0, boost::math::tools::eps_tolerance<double>(30), iterations);
  return 0.5 * (bracket.first + bracket.second);
}

void scale_loss(models::TireFile& tire, double factor) {
  tire.values.rolling_resistance.A0_N *= factor;
  tire.values.rolling_resistance.A1_N_s_per_m *= factor;
}

}  // namespace rollrig::tools
