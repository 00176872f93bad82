#pragma once
/// Rolling resistance by ISO 28580's deceleration method (`rollrig fit drum-coastdown`).

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimation/drum_deceleration/rig_resonance.h"
#include "estimation/run_checks/run_doubt.h"
#include "sim/core/json.h"

namespace rollrig::estimation {

/// A number with its 95 % interval by Student's distribution.
struct Interval {
  double value = 0.0;
  double sd = 0.0;
  double freedom = 0.0;  // degrees of freedom, by Welch and Satterthwaite where parts are summed
  double lower = 0.0;
  double upper = 0.0;
};

/// One body of one run: its coast, and its deceleration at each speed asked for.
struct CoastAnalysis {
  std::size_t run = 0;  // index in the set
  CoastBody body = CoastBody::kDrum;
  Coast coast;
  std::vector<SpeedRange> left_out;
  std::vector<DecelerationFit> decelerations;  // one a speed
};

/// A resonance with the runs that show it.
struct FoundResonance {
  CoastState state = CoastState::kLoaded;
  double pressure_Pa = 0.0;  // of loaded runs; 0 when those of every pressure show it
  Resonance resonance;
};

/// Means of one pressure (and load) at one speed.
struct PressureLevel {
  double pressure_Pa = 0.0;
  double load_N = 0.0;  // 0 where not known
  std::size_t runs = 0;
  bool in_range_left_out = false;  // interpolated over a range that was left out
  double loaded_m_s2 = 0.0;
  Interval net_m_s2;                // F_r/(I_D/R^2)
  std::optional<Interval> force_N;  // where the inertia is known
  std::optional<Interval> ratio;    // over the reference pressure and speed
};

/// Everything at one speed.
struct SpeedPoint {
  double speed_m_s = 0.0;
  std::optional<Interval> drum_alone_m_s2;
  std::optional<Interval> drum_repeatability;  // standard deviation from run to run over the mean [1]
  std::optional<Interval> wheel_alone_m_s2;
  std::vector<PressureLevel> levels;
  std::optional<Interval> pressure_exponent;    // of force over gauge pressure
  std::optional<Interval> exponent_by_repeats;  // the same line, its interval from runs at one pressure alone
  bool is_exponent_by_law = false;              // its interval has the scatter about the line, not that of runs
  double exponent_per_mass_ratio = 0.0;         // by how much it moves with mu
  std::optional<double> level_scatter;          // of the levels about the power law [1]
  double repeat_scatter = 0.0;                  // of runs at one pressure, in the net deceleration [1]
  std::optional<double> lack_of_fit_p;          // of the power law, by the F test
  std::optional<Interval> direction_ratio;      // first direction (by alphabet) over second, less 1
  double direction_sd = 0.0;                    // of that ratio from pressure to pressure
};

struct DrumCoastdownFit {
  std::vector<CoastAnalysis> analyses;
  std::vector<FoundResonance> resonances;
  std::vector<SpeedPoint> points;  // one a speed asked for
  std::vector<std::string> directions;
  double reference_pressure_Pa = 0.0;
  double mass_ratio = 0.0;
  std::vector<std::string> warnings;
  std::vector<RunDoubt> doubts;
  std::shared_ptr<const DrumCoastdownFit> others;  // without the runs in doubt, if there are some
};

/// The coast of each body of each run.
/// Errors    InputError: no coast in a run
std::vector<CoastAnalysis> find_coasts(const CoastSet& set);

/// The whole evaluation: coasts, resonances, decelerations, and what follows from them with intervals in which
/// the scatter from run to run counts, not that within runs alone.
/// Equation  net deceleration by models::calc_net_deceleration, force times I_D/R^2. Variance of a level: pooled
///           scatter of loaded runs at one pressure over their number, plus that of the lifted runs' mean, which all
///           levels share. Exponent: line of ln(net) over ln(p) through the levels' means, its interval from their
///           scatter about the line (the law's own lack of fit counts) and the shared lifted part. Repeated recordings
///           are counted once. Runs in doubt (check_coasts()) stay in; `others` does without them.
/// Validity  intervals ask for two lifted runs and for two runs at one pressure; otherwise scatter within runs alone
///           stands in, and a warning says so
/// Source    ISO 28580 (models/deceleration_method.h); Satterthwaite, Biometrics Bulletin 2 (1946) 110
/// Errors    InputError: no coast in a run; RunFailure: no speed at which loaded and lifted runs both pass
/// Checked   tests/estimation/drum_coastdown_test.cpp, tests/published/drum_coastdown_test.cpp
DrumCoastdownFit fit_drum_coastdown(const CoastSet& set);

Json make_coastdown_json(const CoastSet& set, const DrumCoastdownFit& fit);
/// Every deceleration, a row each.
std::string make_deceleration_csv(const CoastSet& set, const DrumCoastdownFit& fit);
/// Rows of every fit with what is left of them, for plots.
std::string make_residual_csv(const CoastSet& set, const DrumCoastdownFit& fit);

}  // namespace rollrig::estimation
