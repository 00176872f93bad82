#include "tools/virtual_run.h"

#include <fmt/format.h>

#include <boost/math/tools/roots.hpp>

#include "models/tire/own_number.h"

namespace rollrig::tools {

scenarios::RunSpec make_spec(const std::string& scenario, const std::string& tire,
                             const std::vector<std::string>& settings, const std::map<std::string, std::string>& more) {
  ConfigTable document = scenarios::make_run_document(scenario);
  std::map<std::string, std::string> keys{{"tire", tire}, {"fidelity", "quasi_static"}};
  for (const auto& [key, value] : more) keys[key] = value;
  for (const auto& [key, value] : keys) set_config_value(document, key, '"' + value + '"', "tools");
  for (const std::string& setting : settings) scenarios::set_run_value(document, setting);
  return scenarios::read_run_spec(document, "");
}

scenarios::RunSpec make_source_drive(const std::string& tire) {
  return make_spec("sae_j1634", tire, {"variant=source", "wheels=1"});
}

double number(const Json& result, const char* key) {
  if (!result[key].is_number()) throw RunFailure(fmt::format("'{}' could not be read off the virtual test", key));
  return result[key].get<double>();
}

double find_loss_factor(double rrc_N_per_kN) {
  const scenarios::RunSpec plain = make_spec("iso_28580", "a50");
  const auto miss = [&](double factor) {
    scenarios::RunSpec spec = plain;
    scale_loss(spec.tire, factor);
    return number(scenarios::run_scenario(spec, {}).result, "rrc_25degC_2m_N_per_kN") - rrc_N_per_kN;
  };
  return find_root(miss, 0.5, 4.0);
}

void scale_loss(models::TireFile& tire, double factor) {
  tire.values.rolling_resistance.A0_N *= factor;
  tire.values.rolling_resistance.A1_N_s_per_m *= factor;
  if (double* loss_N = models::find_own_number(tire.values.own, "loss_N")) *loss_N *= factor;
}

double find_root(const std::function<double(double)>& f, double low, double high) {
  std::uintmax_t iterations = 60;
  const auto bracket =
      boost::math::tools::toms748_solve(f, low, high, boost::math::tools::eps_tolerance<double>(30), iterations);
  return 0.5 * (bracket.first + bracket.second);
}

}  // namespace rollrig::tools
