#include "tools/class_tire.h"

#include "tools/virtual_run.h"

namespace rollrig::tools {

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
}

}  // namespace rollrig::tools
