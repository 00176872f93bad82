#pragma once
/// A run that a file gives row by row, and how it begins: what a set says of a run, as settings.

#include <optional>

#include "measurements/measurement_set.h"
#include "scenarios/run/settings.h"

namespace rollrig::scenarios {

/// Settings of scenarios that follow a file as a run of a measurement set is replayed.
struct RecordedInputs {
  FilePath program;
  std::optional<double> pressure_Pa;
  std::optional<double> initial_tire_K;
  std::optional<double> rest_before_s;
  Choice tire_state{"soaked", {"soaked", "warm"}};
  double run_up_s = 0.0;
  measurements::MeasuredRun run;  // what the file holds

  /// All but the file and the state of the tire, of which each scenario has its own to say.
  template <class Self, class Visit>
  static void visit_start(Self& p, Visit&& visit) {
    visit(Field{"pressure_kPa", between(50.0, 1000.0),
                "Gauge pressure at the tire's initial temperature; default: the tire's [iso_28580] pressure"},
          p.pressure_Pa);
    visit(Field{"initial_tire_temperature_degC", between(-60.0, 120.0),
                "Rubber, gas and rim at the start; default: as the air of the first row"},
          p.initial_tire_K);
    visit(Field{"rest_before_min", between(0.0, 1e5),
                "Standstill before the run, after driving; effects that remember, such as flat_spot, start "
                "accordingly; default: soaked"},
          p.rest_before_s);
    visit(
        Field{"run_up_s", between(1.0, 3600.0),
              "From standstill to the first row's speed, before time 0, all else as in that row; none where the first "
              "row stands. Assumed: 60 s",
              60.0},
        p.run_up_s);
  }

  const std::vector<double>& column(const char* name) const { return run.columns.at(name); }

  /// Reads the file and fills what it decides. Throws InputError.
  void complete(const RunSpec& spec);

  /// The run as it is simulated and recorded: run-up and file, the file's first row at 0 s. Rows every interval, and
  /// where the file has one, so that its straight lines and load steps stay what they are.
  measurements::MeasuredRun make_rows(const RunSpec& spec) const;
};

/// Distance over the rows of a run, straight lines between them.
double calc_distance_m(const measurements::MeasuredRun& run);

}  // namespace rollrig::scenarios
