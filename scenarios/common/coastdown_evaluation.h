#pragma once
/// Coastdowns as part of a procedure: how they are driven, and the road load that is read off them.

#include <string>

#include "estimation/road_load/road_load_fit.h"
#include "scenarios/common/vehicle_program.h"

namespace rollrig::scenarios {

/// Settings of a warm-up at constant speed and of pairs of coastdowns after it.
struct Coastdowns {
  double from_m_s = 0.0;
  double to_m_s = 0.0;
  int pairs = 0;
  double warm_up_s = 0.0;
  double warm_up_speed_m_s = 0.0;
  double slope = 0.0;
  double wind_m_s = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"from_km_h", between(30.0, 250.0), "Speed from which the vehicle coasts (§3.4.3)", 130.0}, p.from_m_s);
    visit(Field{"to_km_h", between(0.0, 200.0), "Speed at which it is braked; 0: it rolls to standstill", 0.0},
          p.to_m_s);
    visit(Field{"pairs", between(1.0, 20.0), "Coastdowns in either direction", 1.0}, p.pairs);
    visit(Field{"warm_up_min", between(0.0, 600.0), "Before them (SAE J2263: 30 min)", 30.0}, p.warm_up_s);
    visit(Field{"warm_up_speed_km_h", between(20.0, 250.0), "Likewise (SAE J2263: 80 km/h)", 80.0},
          p.warm_up_speed_m_s);
    visit(Field{"slope_percent", between(-10.0, 10.0), "Of the road, uphill in the first direction", 0.0}, p.slope);
    visit(Field{"wind_m_s", between(-20.0, 20.0), "Along the road, against the first direction", 0.0}, p.wind_m_s);
  }

  /// Throws InputError where to_km_h is not well below from_km_h, or where slope or wind is given on a dynamometer.
  void check(const RunSpec& spec) const;
  /// Warm-up and coastdowns.
  void append_to(VehicleProgram& program) const;
  /// Coastdowns alone.
  void append_coastdowns_to(VehicleProgram& program) const;
};

/// Whether a phase is one of Coastdowns.
bool is_coastdown(const std::string& phase);

/// Traces of the coastdowns in a recording, and how A, B, C are fitted to them.
struct CoastdownInputs {
  estimation::CoastdownData data;
  estimation::RoadLoadFitOptions options;
};
/// Throws RunFailure where a coastdown does not come to its end.
CoastdownInputs take_coastdowns(const sim::Recording<double>& recording, const RunSpec& spec,
                                const VehicleConditions& conditions, const Coastdowns& coastdowns);

/// A, B, C of the coastdowns in a recording, from their traces and what a test team knows: weather, road, mass,
/// rotating mass. On a dynamometer they are those of rollers, tires and driveline together, at the conditions of the
/// test. Throws RunFailure where one does not come to its end.
estimation::RoadLoadFit fit_coastdowns(const sim::Recording<double>& recording, const RunSpec& spec,
                                       const VehicleConditions& conditions, const Coastdowns& coastdowns);

/// Speeds at which forces are shown and judged: 20 to 130 km/h.
const std::vector<double>& road_load_speeds_m_s();

}  // namespace rollrig::scenarios
