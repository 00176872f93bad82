#pragma once
/// Rolling resistance by the four methods of ISO 28580: force at the spindle, torque of the drum, power of its motor,
/// deceleration of a coast.

#include <optional>
#include <string>
#include <vector>

#include "scenarios/common/drum_program.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios {

/// F_r by one method, and what follows from it.
struct MethodResult {
  std::string name;  // "torque"
  double rolling_resistance_N = 0.0;
  double rrc = 0.0;
  double corrected_rrc = 0.0;
  double difference = 0.0;  // of F_r to that of the torque method, relative

  void visit(ResultSheet& visit) const {
    visit(Result{"name", "method", "", "force, torque, power or deceleration"}, name);
    visit(Result{"rolling_resistance_N", "F_r", ".2f", "F_r by this method"}, rolling_resistance_N);
    visit(Result{"rrc_N_per_kN", "RRc", ".3f", "F_r over load"}, rrc);
    visit(Result{"rrc_25degC_2m_N_per_kN", "RRc at 25 degC, 2 m", ".3f", "RRc corrected to 25 degC and the 2 m drum"},
          corrected_rrc);
    visit(Result{"difference_percent", "to torque", "+.2f", "difference of F_r to that of the torque method"},
          difference);
  }
};

constexpr const char* kForceMethod = "force";
constexpr const char* kTorqueMethod = "torque";
constexpr const char* kPowerMethod = "power";
constexpr const char* kDecelerationMethod = "deceleration";
const std::vector<std::string>& list_iso_methods();

/// What a method reads in the last cycle, and what makes its two readings a force.
struct MethodReadings {
  std::string method;
  double loaded = 0.0;     // torque [Nm], of a belt force [N]; force of the spindle [N]; power [W]; deceleration [m/s2]
  double skim = 0.0;       // likewise
  double loaded_sd = 0.0;  // of a deceleration alone, by the scatter of its coast
  double skim_sd = 0.0;    // likewise
  double misalignment_rad = 0.0;  // of the force cell of the force method
};

/// `band_m_s` is that of the coasts of the deceleration method. Throws RunFailure as calc_deceleration_method_N().
MethodReadings read_method(const std::string& method, const sim::Recording<double>& recording, const RunSpec& spec,
                           const Cycle& cycle, double band_m_s);

/// F_r by the power of the motor.
/// Equation  F_r = P/v - P_skim/v_skim
/// Symbols   P mean mechanical power of the motor, v speed of the surface; loaded and in the skim test
/// Source    power method of UN Regulation No. 117, Annex 6, and of ISO 28580:2018, 8.1.4 (of both, the title was
///           read); there P/v is 3.6 V A/U of the electric power V A and the speed U in km/h. Assumed: the losses of
///           the motor are the same loaded and in the skim test, and cancel
double calc_power_method_N(const sim::Recording<double>& recording, const RunSpec& spec, const Cycle& cycle);

/// F_r that the force method reads where the spindle's force cell is not at a right angle to the load.
/// Equation  F_t <- F_t + F_z sin d, loaded and in the skim test
/// Symbols   d angle [rad]
double add_misalignment_N(double force_method_N, const Cycle& cycle, const RunSpec& spec, double angle_rad);

/// How far the speed of a coast lies above and below the test speed: 5 km/h, or more where the coast would have fewer
/// than twenty samples, at most a quarter of the speed. Assumed: all of it; the deceleration is that of the tire's RRc
/// at the test load, of the drum's inertia alone.
double find_coast_band_m_s(const RunSpec& spec, const DrumConditions& conditions);

/// Appends to the phases under a load: up to the test speed and the band, a coast to the test speed less the band, and
/// back to the test speed. The coast is the phase "coast, <name>".
void add_coast(DrumProgram& program, const std::string& name, double speed_m_s, double band_m_s);

/// F_r from the coasts "coast, loaded" and "coast, skim".
/// Equation  F_r = (I_D/R^2 + I_T/r^2) a - F_pl, F_pl = (I_D/R^2 + I_T/r_s^2) a_s
/// Symbols   I_D inertia of the drum as the rig's file states it, R its radius; I_T inertia of tire and wheel, r and r_s
///           loaded radius under load and in skim; a and a_s deceleration of the surface at the test speed, of the
///           solution of dv/dt = -(a_0 + a_1 x + a_2 x^2) that fits the speed over time; a belt has its mass in the
///           place of I_D/R^2
/// Validity  no slip; the tire stays on the drum at the skim load, in place of being lifted, so that F_pl has the loss
///           of the tire there, as that of the other methods
/// Errors    RunFailure: a coast has too few samples
/// Source    deceleration method of UN Regulation No. 117, Annex 6, 4.6.2 and 5.1.6, and of ISO 28580:2018, 7.6.3 and
///           8.1.5 (the titles were read); models/deceleration_method.h
/// Checked   tests/scenarios/iso_methods_test.cpp
double calc_deceleration_method_N(const sim::Recording<double>& recording, const RunSpec& spec, const Cycle& cycle,
                                  double band_m_s);

/// Mass at the surface of drum, or belt, and wheel under a load: I_D/R^2 + I_T/r^2.
double calc_coasting_mass_kg(const RunSpec& spec, double load_N);

}  // namespace rollrig::scenarios
