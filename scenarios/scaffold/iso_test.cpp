#include "scenarios/scaffold/iso_test.h"

#include <cmath>

#include <fmt/format.h>

#include "models/tire/own_number.h"
#include "scenarios/run/run_spec.h"
#include "sim/core/assets.h"

namespace rollrig::scenarios {

namespace {

Outcome simulate_iso_test(const models::TireFile& tire) {
  RunSpec spec;
  spec.scenario = &find_scenario("iso_28580");
  spec.tire = tire;
  spec.rig = rigs::read_rig(read_config(find_asset("rigs", spec.scenario->default_rig)));
  rigs::use_skim_load_of_class(spec.rig, tire);
  spec.fidelity = Fidelity::kQuasiStatic;
  return run_scenario(spec, {});
}

double read_rrc(const Outcome& outcome) { return outcome.result["rrc_25degC_2m_N_per_kN"].get<double>() * 1e-3; }

}  // namespace

double simulate_iso_rrc(const models::TireFile& tire) { return read_rrc(simulate_iso_test(tire)); }

StatedIsoTest simulate_stated_iso_test(const models::TireFile& tire) {
  const Outcome test = simulate_iso_test(tire);
  if (test.result.contains("why_no_label")) {
    throw InputError({fmt::format("the simulated test of tire '{}' gives no RRc to state: {}", tire.name,
                                  test.result["why_no_label"].get<std::string>()),
                      tire.path, 0, "", "", "a table [iso_28580] with the test of the class, or --rrc NUMBER in N/kN",
                      ""});
  }
  return {read_rrc(test), test.warnings};
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
  const Outcome test = simulate_iso_test(tire);
  const double rrc = read_rrc(test);
  const double difference = rrc / tire.iso_28580->rrc - 1.0;
  if (std::abs(difference) <= kIsoTolerance) return std::nullopt;
  std::string warning = fmt::format(
      "the simulated test of ISO 28580 gives an RRc of {:.3f} N/kN, {:+.1f} % from the {:.3f} N/kN that the file "
      "states; "
      "if they are more than {:.0f} % apart, one of them is not that of this tire",
      1e3 * rrc, 100.0 * difference, 1e3 * tire.iso_28580->rrc, 100.0 * kIsoTolerance);
  for (const std::string& of_test : test.warnings) warning += ". " + of_test;
  return warning;
}

}  // namespace rollrig::scenarios
