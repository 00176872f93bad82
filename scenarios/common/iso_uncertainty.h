#pragma once
/// The coefficient of an ISO 28580 test as a measurement, for its uncertainty.

#include <functional>
#include <optional>
#include <vector>

#include "estimation/uncertainty/measurement_model.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios {

/// Accuracies of the instruments, half-widths of rectangular distributions, as their certificates have them. What is
/// absent is assumed.
struct IsoAccuracies {
  std::optional<double> gain;
  std::optional<double> load;
  std::optional<double> drum_diameter_m;
  std::optional<double> ambient_K;
  std::optional<double> speed_m_s;
  std::optional<double> pressure_Pa;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"gain_accuracy_percent", between(0.0, 50.0),
                "For the uncertainty budget: +- of the gain of torque or force. Default: 0.5, assumed"},
          p.gain);
    visit(Field{"load_accuracy_percent", between(0.0, 50.0), "Likewise of the load. Default: 0.5, assumed"}, p.load);
    visit(Field{"drum_diameter_accuracy_m", between(0.0, 1.0), "Likewise. Default: 0.001, assumed"}, p.drum_diameter_m);
    visit(Field{"ambient_accuracy_K", between(0.0, 20.0), "Likewise of the air temperature. Default: 0.2, assumed"},
          p.ambient_K);
    visit(Field{"speed_accuracy_km_h", between(0.0, 20.0), "Likewise. Default: 0.1, assumed"}, p.speed_m_s);
    visit(Field{"pressure_accuracy_kPa", between(0.0, 100.0),
                "Likewise of the pressure as set. Default: by the sensor of the cavity pressure, else 1, assumed"},
          p.pressure_Pa);
  }
};

/// F_r of the test at another speed [m/s] and another cold pressure [Pa], without errors of sensors.
using IsoSimulation = std::function<double(double speed_m_s, double pressure_Pa)>;

/// RRc of the last cycle, corrected to 25 degC and the 2 m drum, as correct_rrc() has it, and RRc as measured.
/// Equation  RRc = (1 + g) (T_t - T_skim + e) r(v, p) / (R L) K_r(R) (1 + K_t (T_amb - 25 degC))
/// Symbols   T_t, T_skim readings of torque (of a belt: force, R = 1); o their common offset, which cancels; g relative
///           error of their gain; e error of their difference from noise, drift and resolution, or from cycle to cycle;
///           L reading of the load; R = D/2 radius of the drum; r(v, p) = F_r(v, p) / F_r(v_0, p_0), by simulation in
///           second order; K_r, K_t of correct_rrc()
/// Validity  errors of instruments, not of the procedure: a tire that is not warm is in `unsettled`
/// Source    the equations of readings.h. Uncertainties: `accuracies`, sensors of the run, else usual ones of the
///           machine, else "Assumed", which the budget marks
/// Checked   tests/scenarios/iso_uncertainty_test.cpp
estimation::MeasurementModel make_iso_model(const RunSpec& spec, const std::vector<Cycle>& cycles, double pressure_Pa,
                                            const IsoAccuracies& accuracies, const IsoSimulation& simulate);

}  // namespace rollrig::scenarios
