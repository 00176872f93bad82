#include "scenarios/scaffold/iso_test.h"

#include <cmath>

#include <fmt/format.h>

#include "models/tire/own_number.h"
#include "scenarios/run/run_spec.h"
#include "scenarios/scaffold/tire_size.h"
#include "sim/core/assets.h"

namespace rollrig::scenarios {

double find_iso_warm_up_s(const models::TireFile& tire) {
  static const double heavy_N = 0.85 * find_load_capacity_N("121");
  constexpr double kLargeRim_m = 0.571;  // 22.5 inches
  constexpr double kMinute_s = 60.0;
  const bool is_heavy = tire.iso_28580.has_value() && tire.iso_28580->load_N > heavy_N;
  if (is_heavy) return (tire.values.geometry.rim_diameter_m > kLargeRim_m ? 180.0 : 150.0) * kMinute_s;
  const bool is_commercial = !tire.designation.empty() && tire.designation.back() == 'C';
  return (is_commercial ? 50.0 : 30.0) * kMinute_s;
}

double simulate_iso_rrc(const models::TireFile& tire) {
  RunSpec spec;
  spec.scenario = &find_scenario("iso_28580");
  spec.tire = tire;
  spec.rig = rigs::read_rig(read_config(find_asset("rigs", spec.scenario->default_rig)));
  spec.fidelity = Fidelity::kQuasiStatic;
  set_config_value(spec.settings, "warm_up_min", fmt::format("{}", find_iso_warm_up_s(tire) / 60.0), "ISO 28580");
  return run_scenario(spec, {}).result["rrc_25degC_2m_N_per_kN"].get<double>() * 1e-3;
}

void scale_to_iso_rrc(models::TireFile& tire) {
  constexpr int kMost = 40;
  constexpr double kClose = 1e-6;  // of RRc; files state it to three digits
  double* loss_N = models::find_own_number(tire.values.own, "loss_N");
  double* loss_sd_N = models::find_own_number(tire.standard_uncertainties.own, "loss_N");
  for (int i = 0; i < kMost; ++i) {
    const double ratio = tire.iso_28580->rrc / simulate_iso_rrc(tire);
    *loss_N *= ratio;
    *loss_sd_N *= ratio;
    if (std::abs(ratio - 1.0) < kClose) return;
  }
  throw RunFailure("no loss of the tire gives the RRc in the test of ISO 28580");
}

std::optional<std::string> check_iso_rrc(const models::TireFile& tire) {
  if (!tire.iso_28580.has_value()) return std::nullopt;
  const double rrc = simulate_iso_rrc(tire);
  const double difference = rrc / tire.iso_28580->rrc - 1.0;
  if (std::abs(difference) <= kIsoTolerance) return std::nullopt;
  return fmt::format(
      "the simulated test of ISO 28580 gives an RRc of {:.3f} N/kN, which is {:+.1f} % from the {:.3f} N/kN that the "
      "file "
      "states; more than {:.0f} % apart, one of them is not that of this tire",
      1e3 * rrc, 100.0 * difference, 1e3 * tire.iso_28580->rrc, 100.0 * kIsoTolerance);
}

}  // namespace rollrig::scenarios
