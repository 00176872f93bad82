#pragma once
/// Tests at several loads and pressures (SAE J2452, SAE J1269): their points, and how they are prepared.

#include "estimation/rolling_law/rolling_points.h"
#include "scenarios/common/drum_conditions.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios {

/// A load, and the pressure that is set on the cold tire.
struct TestPoint {
  double load_N = 0.0;
  double pressure_Pa = 0.0;
};

/// What tests of several loads and pressures share. The conditions' pressure is the base pressure.
struct MultipointSettings {
  DrumConditions conditions;
  std::optional<double> maximum_load_N;
  std::vector<double> loads;         // of the maximum load
  std::vector<double> pressures_Pa;  // above the base pressure
  std::optional<double> warm_up_s;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(
        Field{"maximum_load_N", between(100.0, 100000.0),
              "Maximum load of the tire; default: the load of its load index ([service_description]), else that of its "
              "[iso_28580] over 0.8, the share of class C1"},
        p.maximum_load_N);
    visit(Field{"pressure_kPa", between(50.0, 1500.0),
                "Base pressure, gauge. Assumed default: 30 kPa above the pressure of the tire's [iso_28580], which "
                "gives 240 and 280 kPa for standard and reinforced tires"},
          p.conditions.pressure_Pa);
    visit(Field{"loads_percent", between(1.0, 200.0), "Load of each test point, of the maximum load"}, p.loads);
    visit(Field{"pressures_above_base_kPa", between(-500.0, 500.0),
                "Pressure of each test point above the base pressure, as set on the cold tire"},
          p.pressures_Pa);
    visit(Field{"warm_up_min", between(1.0, 600.0),
                "Load of each test point before it is read; default: warm_up_min of the tire's [iso_28580], else 30"},
          p.warm_up_s);
    visit(Field{"ambient_degC", between(-60.0, 80.0),
                "Air at the tire; default: the practices' reference (TRB Special Report 286, Table A-1)", 24.0},
          p.conditions.ambient_K);
    visit(Field{"surface_temperature_degC", between(-60.0, 120.0), "Drum surface; default: as the air"},
          p.conditions.surface_K);
    visit(Field{"initial_tire_temperature_degC", between(-60.0, 120.0),
                "Tire at the start of the soak; default: as the air"},
          p.conditions.initial_tire_K);
    DrumConditions::visit_procedure(p.conditions, visit);
  }

  /// Fills what the tire decides. Throws InputError where it cannot, and where loads and pressures are no pairs.
  void complete(const RunSpec& spec);
  std::vector<TestPoint> list_points() const;
  estimation::ReferenceCondition make_reference() const;
};

/// A point of rolling resistance as a test reads it.
struct RollingStep {
  Cycle cycle;
  double pressure_set_Pa = 0.0;

  estimation::RollingPoint to_point() const;

  void visit(ResultSheet& visit) const {
    cycle.visit(visit);
    visit(Result{"pressure_set_kPa", "set", ".0f", "as set after the soak, gauge"}, pressure_set_Pa);
  }
};

}  // namespace rollrig::scenarios
