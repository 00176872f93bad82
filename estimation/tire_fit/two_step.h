#pragma once
/// The source's own identification, in two steps and by linear regression (§3.3.1.2, §3.3.2.2): where a
/// fit starts, and what a user of the source's method would have got.

#include <optional>
#include <vector>

#include "measurements/measurement_set.h"

namespace rollrig::estimation {

/// A and B of one speed (source (3.6)).
struct SpeedFit {
  double speed_m_s = 0.0;
  double A_N = 0.0;
  double B_per_K = 0.0;
};

struct TwoStepEstimate : models::SpeedLines<double> {
  std::vector<SpeedFit> speeds;
  double rest_conductance_W_per_K = 0.0;       // the source's z
  double speed_conductance_W_s_per_m_K = 0.0;  // its f
  std::optional<double> H_gas_W_per_K;         // where the gas temperature was measured
  bool slopes_held = false;                    // one speed: A1, B1 and f are those of the files

  double mean_speed_m_s() const;
};

/// Step 1: ln of the loss, freed of pressure and load, over the liner temperature, for every speed; A and
/// B straight lines over speed. Step 2: the heat balance (3.19), integrated over time so that nothing is
/// differentiated, solved for z and f by least squares; (3.16) for H likewise.
/// Uses    parasitic loss, heat capacities and (where not measured) H and gas temperature as the files say
///         from one speed also A1, B1 and f as the files say; A0, B0 and z then make up the level there
/// Errors  InputError: no speed with loss and temperature
TwoStepEstimate estimate_in_two_steps(const measurements::MeasurementSet& set);

}  // namespace rollrig::estimation
