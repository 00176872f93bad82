#pragma once
/// What a test engineer reads off a recording: means over windows, rolling resistance per cycle (§3.2.3.2),
/// its corrections (§3.2.3.3) and its uncertainty (§4.1.1).

#include <string>
#include <vector>

#include "scenarios/common/drum_conditions.h"
#include "scenarios/common/range_finder.h"

namespace rollrig::scenarios {

/// Means over one window.
struct Reading {
  Window window;
  int samples = 0;
  double load_N = 0.0;
  double speed_m_s = 0.0;
  double ambient_K = 0.0;
  double drum_torque_Nm = 0.0;
  double spindle_force_N = 0.0;
  double liner_temperature_K = 0.0;
  double pressure_Pa = 0.0;
};

Reading take_reading(const sim::Recording<double>& recording, const Window& window, double interval_s);

/// A load followed by a skim test.
struct Cycle {
  Reading loaded;
  Reading skim;
  double parasitic_N = 0.0;           // F_pl = T_skim/R
  double rolling_resistance_N = 0.0;  // F_r = T_t/R - F_pl
  double rrc = 0.0;                   // N/N
  double force_method_N = 0.0;        // F_r from the spindle force
};

/// F_r of a loaded and a skim reading, by both of the standard's methods.
/// Equation  torque method  F_r = T_t/R - T_skim/R;  force method F_r = F_t (1 + r_l/R) - F_t,skim (1 + r_l,skim/R)
/// Source    §3.2.3.2; the force method from ISO 28580 (source [2]), with the loaded radius of each reading
Cycle evaluate_cycle(const Reading& loaded, const Reading& skim, const RunSpec& spec);

/// Ranges of constant load and speed from `from_s` on, found from the load signal (B.2).
std::vector<LoadRange> find_test_ranges(const sim::Recording<double>& recording, const RunSpec& spec, double from_s);

/// Every load that a skim test follows, from `from_s` on, at least one. Throws RunFailure when there is none.
std::vector<Cycle> find_cycles(const sim::Recording<double>& recording, const RunSpec& spec,
                               const DrumConditions& conditions, double from_s);

/// RRc corrected to 25 degC and to the 2 m drum.
/// Equation  RRc K_r (1 + K_t (T_amb - 25 degC)), K_t = 0.008 1/degC, K_r of (3.1) to R_2 = 1 m
/// Validity  car tires, 20 to 30 degC; warned of outside
/// Source    ISO 28580 as in §3.2.3.3, K_t from the standard
double correct_rrc(double rrc, double ambient_K, const RunSpec& spec);
bool is_correction_valid(double ambient_K);

/// Expanded uncertainty (k = 2) of a cycle's RRc, corrected as correct_rrc does, from the torque sensor.
struct RrcUncertainty {
  double offset_cancelled = 0.0;  // load minus skim in one session: the offset drops out
  double offset_kept = 0.0;       // as if each torque stood alone: +-0.9 N m, as the source judges (§4.1.1)
};
RrcUncertainty calc_rrc_uncertainty(const Cycle& cycle, const RunSpec& spec);

/// The torque sensor by which uncertainties are stated: the run's, else that of the source's rig.
models::SensorParameters find_torque_sensor(const RunSpec& spec);

Json to_json(const Cycle& cycle);
/// Adds every cycle to `result` (key "cycles") and to a table for a person.
void add_cycles(const std::string& title, const std::vector<Cycle>& cycles, Outcome& outcome);

}  // namespace rollrig::scenarios
