#pragma once
/// What a test engineer reads off a recording: means over windows, rolling resistance per cycle (§3.2.3.2),
/// its corrections (§3.2.3.3) and its uncertainty (§4.1.1), and what sweeps make of several of them.

#include <array>
#include <optional>
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
  double force_N = 0.0;                  // of the machine, at its surface
  std::optional<double> drum_torque_Nm;  // where it is read as a torque
  double spindle_force_N = 0.0;
  double liner_temperature_K = 0.0;
  double pressure_Pa = 0.0;
};

/// Mean of a channel over a window.
double calc_mean(const sim::Recording<double>& recording, const RunSpec& spec, const Window& window,
                 const Quantity& quantity);
Reading take_reading(const sim::Recording<double>& recording, const RunSpec& spec, const Window& window);

/// A load followed by a skim test.
struct Cycle {
  Reading loaded;
  Reading skim;
  double parasitic_N = 0.0;           // F_pl = T_skim/R, of a belt the force in skim
  double rolling_resistance_N = 0.0;  // F_r = T_t/R - F_pl
  double rrc = 0.0;                   // N/N
  double force_method_N = 0.0;        // F_r from the spindle force

  void visit(ResultSheet& visit) const {
    visit(Result{"start_s", "start", ".0f", "start of the window that is averaged under load", Column::kSecond},
          loaded.window.start_s);
    visit(Result{"end_s", "end", ".0f", "its end", Column::kBoth}, loaded.window.end_s);
    visit(Result{"skim_start_s", "skim start", ".0f", "start of the window in the skim test", Column::kSecond},
          skim.window.start_s);
    visit(Result{"skim_end_s", "skim end", ".0f", "its end", Column::kSecond}, skim.window.end_s);
    visit(Result{"load_N", "load", ".0f", "mean load"}, loaded.load_N);
    visit(Result{"speed_km_h", "", ".1f", "mean speed"}, loaded.speed_m_s);
    visit(Result{"drum_torque_Nm", "torque", ".2f", "mean motor torque under load; none on a belt"}.or_left_out(),
          loaded.drum_torque_Nm);
    visit(Result{"skim_torque_Nm", "skim", ".2f", "mean motor torque in skim", Column::kSecond}.or_left_out(),
          skim.drum_torque_Nm);
    visit(Result{"parasitic_N", "skim", ".2f", "F_pl; by torque: skim torque over drum radius, of a belt the force"},
          parasitic_N);
    visit(Result{"rolling_resistance_N", "F_r", ".2f", "F_r = F_t - F_pl; by torque: F_t = T_t/R"},
          rolling_resistance_N);
    visit(Result{"rrc_N_per_kN", "RRc", ".3f", "F_r over load"}, rrc);
    visit(Result{"force_method_N", "F_r by force", ".2f", "F_r from the spindle force", Column::kSecond},
          force_method_N);
    visit(Result{"liner_temperature_degC", "liner", ".1f", "mean under load"}, loaded.liner_temperature_K);
    visit(Result{"cavity_pressure_kPa", "", ".1f", "mean under load, gauge"}, loaded.pressure_Pa);
  }

  /// How a cycle was read, on lines.
  static void visit_lines(ResultSheet& visit) {
    visit(JointLine{"Averaging window, load / skim", "{start_s} to {end_s} / {skim_start_s} to {skim_end_s}"});
    visit(JointLine{"Drum torque, load / skim", "{drum_torque_Nm} / {skim_torque_Nm}"});
    visit(JointLine{"Parasitic loss (skim)", "{parasitic_N}"});
  }
};

/// Title of the second table of a list of cycles.
constexpr const char* kCycleWindows = "Windows that were averaged, torque in skim, and F_r by the force method";

/// F_r of a loaded and a skim reading, by both of the standard's methods.
/// Equation  torque method  F_r = T_t/R - T_skim/R;  force method F_r = F_t (1 + r_l/R) - F_t,skim (1 + r_l,skim/R);
///           on a belt forces in the place of T/R, and 1/R = 0
/// Symbols   T motor torque, F_t spindle force, R radius of the drum, r_l loaded radius of the tire
/// Source    §3.2.3.2; the force method from ISO 28580 (source [2]), with the loaded radius of each reading
Cycle evaluate_cycle(const Reading& loaded, const Reading& skim, const RunSpec& spec);

/// Ranges of constant load and speed from time 0 on, found from the load signal (B.2).
std::vector<LoadRange> find_test_ranges(const sim::Recording<double>& recording, const RunSpec& spec);

/// Every load that a skim test follows, at least one. Throws RunFailure when there is none.
std::vector<Cycle> find_cycles(const sim::Recording<double>& recording, const RunSpec& spec,
                               const DrumConditions& conditions);

/// RRc corrected to 25 degC and to the 2 m drum.
/// Equation  RRc K_r (1 + K_t (T_amb - 25 degC))
/// Symbols   K_t of find_ambient_coefficient_per_K(); K_r of (3.1) to R_2 = 1 m; T_amb temperature
///           of the air [degC]
/// Validity  20 to 30 degC; a warning outside
/// Source    ISO 28580 as in §3.2.3.3; K_t from the standard
double correct_rrc(double rrc, double ambient_K, const RunSpec& spec);

/// K_t of [iso_28580] of the tire, else of its class, else 0.008 1/degC of class C1.
double find_ambient_coefficient_per_K(const RunSpec& spec);

/// Expanded uncertainty (k = 2) of a cycle's RRc, corrected as correct_rrc does, from the torque sensor.
struct RrcUncertainty {
  double offset_canceled = 0.0;  // load minus skim in one session: the offset drops out
  double offset_kept = 0.0;      // as if each torque stood alone: +-0.9 N m, as the source judges (§4.1.1)
};
RrcUncertainty calc_rrc_uncertainty(const Cycle& cycle, const RunSpec& spec);

/// The sensor of torque or force by which uncertainties are stated: the run's, else the usual one of the kind, else
/// that of the source's rig.
models::SensorParameters find_force_sensor(const RunSpec& spec);

/// Whether a line can be drawn over these values: two of them differ.
bool has_two_values(const std::vector<double>& x);

/// Slope of ln y over ln x by least squares; both positive, two points at least.
double fit_power(const std::vector<double>& x, const std::vector<double>& y);

/// The warning of a sweep in which a resistance is not positive, so that no power law describes it: a large error of a
/// sensor may be the reason. Nothing where all are positive.
std::optional<std::string> warn_of_no_power(const std::vector<double>& loss_N);

/// Mean of the cycles of one point: torque, skim, F_r and RRc averaged; temperatures and windows of
/// the last.
Cycle average_cycles(const std::vector<Cycle>& cycles);

/// The loads of the source's load sweep for this tire, else ISO load, vehicle load (5400 N) and their mean.
std::vector<double> default_sweep_loads_N(const RunSpec& spec);

}  // namespace rollrig::scenarios
