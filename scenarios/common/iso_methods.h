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
  std::string name;          // "torque"
  double parasitic_N = 0.0;  // F_pl
  double rolling_resistance_N = 0.0;
  double rrc = 0.0;
  double corrected_rrc = 0.0;
  double difference = 0.0;  // of F_r to that of the torque method, relative

  void visit(ResultSheet& visit) const {
    visit(Result{"name", "method", "", "force, torque, power or deceleration"}, name);
    visit(Result{"parasitic_N", "skim", ".2f", "loss in the skim test by this method"}, parasitic_N);
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

/// What a method reads in a cycle. iso_method_budgets.h makes a force of each reading.
struct MethodReadings {
  std::string method;
  double loaded = 0.0;     // torque [Nm], of a belt force [N]; force of the spindle [N]; power [W]; deceleration [m/s2]
  double skim = 0.0;       // likewise
  double loaded_sd = 0.0;  // of a deceleration alone, by the scatter of its coast
  double skim_sd = 0.0;    // likewise
  double misalignment_rad = 0.0;  // of the force cell of the force method
};

/// A cycle of a test, and its place among the cycles, by which its coasts are found.
struct CycleOfTest {
  const Cycle& cycle;
  int place = 0;
};

/// `band_m_s` is that of the coasts of the deceleration method, whose readings are the decelerations of the surface at
/// the test speed.
/// Errors  RunFailure: a coast has too few samples
MethodReadings read_method(const std::string& method, const sim::Recording<double>& recording, const RunSpec& spec,
                           const CycleOfTest& at, double band_m_s);

/// How far the speed of a coast lies above and below the test speed: 5 km/h, or more where the coast would have fewer
/// than twenty samples, at most a quarter of the speed. Assumed: all of it; the deceleration is that of the tire's RRc
/// at the test load, of the drum's inertia alone.
double find_coast_band_m_s(const RunSpec& spec, const DrumConditions& conditions);

/// A coast of a test: in which cycle, and under which load.
struct CoastOfTest {
  int cycle_place = 0;
  bool is_loaded = false;

  /// "loaded", "skim"; in a later cycle "loaded 2".
  std::string name() const;
};

/// Appends to the phases under a load: up to the test speed and the band, a coast to the test speed less the band, and
/// back to the test speed. The coast is the phase "coast, <name>".
void add_coast(DrumProgram& program, const CoastOfTest& coast, double speed_m_s, double band_m_s);

/// Mass at the surface of drum, or belt, and wheel under a load: I_D/R^2 + I_T/r^2.
double calc_coasting_mass_kg(const RunSpec& spec, double load_N);

}  // namespace rollrig::scenarios
