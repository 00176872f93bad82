#pragma once
/// Test conditions that every scenario on the drum shares.

#include <optional>

#include "scenarios/run/settings.h"

namespace rollrig::scenarios {

/// Defaults are those of the source's ISO 28580 procedure (§3.2.3.1) unless a doc text says otherwise.
struct DrumConditions {
  std::optional<double> load_N;
  std::optional<double> pressure_Pa;
  double speed_m_s = 0.0;
  std::optional<double> ambient_K;
  std::optional<double> surface_K;
  std::optional<double> initial_tire_K;
  double soak_s = 0.0;
  double pressure_check_s = 0.0;
  double run_up_s = 0.0;
  double window_s = 0.0;
  double margin_s = 0.0;
  std::optional<double> rest_before_s;  // before the soak, after driving; absent: nothing remembers
  bool started_warm = false;
  bool force_at_standstill = false;  // a set of it says that the torque read at standstill is the zero of its sensor

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"load_N", between(100.0, 100000.0), "Test load; default: the tire's [iso_28580] load"}, p.load_N);
    visit(Field{"pressure_kPa", between(50.0, 1000.0),
                "Gauge pressure set after the soak; default: the tire's [iso_28580] pressure"},
          p.pressure_Pa);
    visit(Field{"speed_km_h", between(5.0, 250.0), "Test speed", 80.0}, p.speed_m_s);
    visit(Field{"ambient_degC", between(-60.0, 80.0), "Air at the tire; default: the rig's"}, p.ambient_K);
    visit(Field{"surface_temperature_degC", between(-60.0, 120.0), "Drum surface; default: as the air"}, p.surface_K);
    visit(Field{"initial_tire_temperature_degC", between(-60.0, 120.0),
                "Tire at the start of the soak; default: as the air"},
          p.initial_tire_K);
    visit_procedure(p, visit);
  }

  /// How a test is prepared and read.
  template <class Self, class Visit>
  static void visit_procedure(Self& p, Visit&& visit) {
    visit(Field{"soak_h", between(0.0, 48.0), "Rest at test temperature", 3.0}, p.soak_s);
    visit(Field{"pressure_check_min", between(0.0, 120.0), "From setting the pressure to verifying it", 10.0},
          p.pressure_check_s);
    visit(Field{"run_up_s", between(1.0, 3600.0), "From standstill to test speed, at skim load. Assumed: 60 s", 60.0},
          p.run_up_s);
    visit(Field{"window_s", between(1.0, 3600.0), "Averaged at the end of a measurement or skim (§3.2.7: last minute)",
                60.0},
          p.window_s);
    visit(Field{"margin_s", between(0.0, 600.0),
                "Left out before and after a change of load (B.2: a few seconds). Assumed: 2 s", 2.0},
          p.margin_s);
  }

  /// Fills what the tire and the rig decide. Throws InputError when the tire has no [iso_28580].
  void complete(const RunSpec& spec);
};

constexpr double kShortestRange_s = 20.0;  // Assumed: shorter stretches of a load signal are transitions

/// Load at or below which the tire counts as skimming.
/// Source    formats.md: the rig's skim load x 1.5
double calc_skim_limit_N(const rigs::RigFile& rig);

/// Throws InputError when a load would press the tire flat.
void check_tire_carries(const RunSpec& spec, const char* key, double load_N);

/// Throws InputError when a load could not be told from a skim test, or would press the tire flat.
void check_test_load(const RunSpec& spec, const char* key, double load_N);

/// The pressure of the tire's [iso_28580]. Throws InputError when it has none.
double find_default_pressure_Pa(const RunSpec& spec);

/// Settings of procedures that are made of cycles: conditions, load and skim times (§3.2.1 items 7 and 8).
struct CycleSettings {
  DrumConditions conditions;
  std::optional<double> warm_up_s;
  double skim_s = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    DrumConditions::visit(p.conditions, visit);
    visit(Field{"warm_up_min", between(1.0, 600.0),
                "Load of the warm-up cycle; default: warm_up_min of the tire's [iso_28580], else 30"},
          p.warm_up_s);
    visit(Field{"skim_min", between(0.5, 600.0), "Skim test after it", 3.0}, p.skim_s);
  }

  /// Fills what the tire and the rig decide, as DrumConditions does.
  void complete(const RunSpec& spec);
};

constexpr double kVehicleLoad_N = 5400.0;      // §3.2.1 item 2
constexpr double kVehiclePressure_Pa = 280e3;  // §3.2.3.4

/// Fills in the load and pressure of the source's vehicle, unless the tire's [validity] begins at a higher load.
void complete_as_on_vehicle(DrumConditions& conditions, const RunSpec& spec);

constexpr double kDefaultSettle_min = 60.0;  // Assumed: leaves less than 0.2 % of RRc of a passenger car's tire

/// The same where the loss is meant as that of a tire in steady state.
struct SteadyCycleSettings : CycleSettings {
  double settle_s = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    CycleSettings::visit(p, visit);
    visit(Field{"settle_min", between(0.0, 600.0),
                "Further load before each measurement, until the tire is in steady state; 0: as in §3.2",
                kDefaultSettle_min},
          p.settle_s);
  }
};

}  // namespace rollrig::scenarios
