#pragma once
/// A run that a file gives row by row, and how it begins: what a set says of a run, as settings.

#include <optional>

#include "measurements/measurement_set.h"
#include "scenarios/run/settings.h"

namespace rollrig::scenarios {

/// Settings of the scenarios that follow a file. They simulate it as a run of a measurement set is simulated again.
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

  /// Reads the file and fills what it decides. Throws InputError.
  void complete(const RunSpec& spec);

  /// The run as it is simulated and recorded: run-up and file, the file's first row at 0 s. Rows every interval, and
  /// where the file has one, so that its straight lines and load steps stay what they are.
  measurements::MeasuredRun make_rows(const RunSpec& spec) const;
};

/// Throws InputError where a tire that starts warm is said to have rested.
void check_rest(const RunSpec& spec, bool started_warm, const std::optional<double>& rest_before_s);

/// What the rows of a file come to, as results.
struct FollowedRows {
  std::string id;
  double duration_s = 0.0;
  double distance_m = 0.0;  // straight lines between the rows

  void visit(ResultSheet& visit) const {
    visit(Remark{"Program"}, id);
    visit(Result{"duration_s", "", ".0f", "of the file's rows"}, duration_s);
    visit(Result{"distance_km", "", ".2f", "of the file's rows"}, distance_m);
    visit(JointLine{"Duration, distance", "{duration_s}, {distance_km}"});
  }
};

/// Temperature and pressure of the tire over a recording, as results.
struct TireCourse {
  double liner_max_K = 0.0;
  double liner_end_K = 0.0;
  double pressure_set_Pa = 0.0;
  double pressure_end_Pa = 0.0;

  void visit(ResultSheet& visit) const {
    visit(Result{"liner_temperature_max_degC", "", ".1f", "highest liner temperature"}, liner_max_K);
    visit(Result{"liner_temperature_end_degC", "", ".1f", "liner temperature at the end"}, liner_end_K);
    visit(Result{"cavity_pressure_end_kPa", "", ".1f", "pressure at the end"}, pressure_end_Pa);
    visit(JointLine{"Liner temperature, highest / at the end",
                    "{liner_temperature_max_degC} / {liner_temperature_end_degC}"});
    visit(JointLine{"Pressure set / at the end",
                    fmt::format("{:.1f} / ", pressure_set_Pa / 1e3) + "{cavity_pressure_end_kPa}"});
  }
};

FollowedRows measure_rows(const measurements::MeasuredRun& run);
TireCourse read_tire_course(const sim::Recording<double>& recording, double pressure_set_Pa);

}  // namespace rollrig::scenarios
