#include "scenarios/common/iso_coefficient.h"

#include "models/corner.h"

namespace rollrig::scenarios {

std::optional<double> calc_true_iso_rrc(const models::TireFile& tire, models::Baseline baseline) {
  const models::TireModelInfo& law = tire.model(baseline).info;
  if (!tire.iso_28580.has_value() || (law.uses("rolling_resistance") && !tire.has_rolling_resistance)) {
    return std::nullopt;
  }
  constexpr double kSkimLoad_N = 200.0;
  constexpr double kSpeed_m_s = 80.0 / 3.6;
  constexpr double kWarm_K = kZeroCelsius_K + 40.0;  // Assumed; the ratio of the two losses hardly depends on it
  models::Context<double> context;
  context.tire = tire.values;
  if (baseline == models::Baseline::kConstantRrc) context.tire.own = {&tire.model(baseline), {}};
  const models::Corner<double> corner(context, {});
  const auto loss_N = [&](double load_N) {
    return corner.calc_law_N(kSpeed_m_s, load_N, tire.iso_28580->pressure_Pa, kWarm_K);
  };
  return tire.iso_28580->rrc / (1.0 - loss_N(kSkimLoad_N) / loss_N(tire.iso_28580->load_N));
}

}  // namespace rollrig::scenarios
